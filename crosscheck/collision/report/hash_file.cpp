#include "crosscheck/collision/report/hash_file.hpp"

#include <fmt/format.h>

#include "reference/model/collision/collision_state.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {

void HashFile::add(const ComparedFrame& f) {
    lines_ += fmt::format("{} {} {}\n", f.frame, hash_text(state_hash(f.reference, f.reference_cdt)),
                          hash_text(state_hash(f.gpu, f.gpu_cdt)));
}

} // namespace lockstep
