#include "reference/known_operations.hpp"

namespace lockstep {

KnownOperations measured_operations(const Profile& profile) {
    const OperationErrors& errors = profile.errors;
    KnownOperations known;
    // What the reference cannot follow may be anything; only the errors of single operations are then to be trusted.
    const bool followed = profile.not_followed.empty();
    known.divide = errors.divide == 0 && errors.reciprocal == 0;
    known.square_root = errors.sqrt == 0 && errors.length == 0;
    known.dot = followed;
    known.normalize = errors.normalize == 0;
    known.subnormals = followed;
    known.points = followed && known.divide;
    return known;
}

} // namespace lockstep
