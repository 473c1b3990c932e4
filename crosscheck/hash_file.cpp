#include "crosscheck/hash_file.hpp"

#include <fmt/format.h>

#include "crosscheck/atomic_file.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {

void HashFile::add(const ComparedFrame& f) {
    lines_ += fmt::format("{} {} {}\n", f.frame, hash_text(state_hash(f.reference, f.reference_cdt)),
                          hash_text(state_hash(f.gpu, f.gpu_cdt)));
}

void HashFile::write(const std::filesystem::path& path) const { write_text_file(path, lines_); }

} // namespace lockstep
