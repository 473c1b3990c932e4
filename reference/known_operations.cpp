#include "reference/known_operations.hpp"

#include <algorithm>
#include <string>

namespace lockstep {

KnownOperations measured_operations(const Profile& profile) {
    const OperationErrors& errors = profile.errors;
    KnownOperations known;
    // What the reference cannot follow may be anything; only the errors of single operations are then to be trusted.
    const bool followed = profile.not_followed.empty();
    const bool arithmetic_followed =
        std::all_of(profile.not_followed.begin(), profile.not_followed.end(),
                    [](const std::string& row) { return row.starts_with("points:") || row.starts_with("triangles:"); });
    // With the driver's own tables, the reference has the driver's quotients and roots.
    const bool tables = profile.roots != nullptr;
    known.divide = tables || (errors.divide == 0 && errors.reciprocal == 0);
    known.square_root = tables || (errors.sqrt == 0 && errors.length == 0);
    known.dot = arithmetic_followed;
    known.normalize = tables || errors.normalize == 0;
    known.subnormals = arithmetic_followed;
    known.points = followed && known.divide;
    return known;
}

} // namespace lockstep
