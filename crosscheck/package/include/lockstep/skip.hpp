#pragma once
#include <cstdlib>
#include <string>

namespace lockstep {

/// Whether the environment says that this has to be there: LOCKSTEP_REQUIRE_GL=1.
inline bool is_required(const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return value != nullptr && *value != '\0' && std::string(value) != "0";
}

/// Reports that the running test case cannot be run here (no GL context), and why:
/// `if (!gl) return skip(gl.missing());`. The program then ends with 77, which CTest shows as skipped
/// (SKIP_RETURN_CODE 77), unless a test fails; with LOCKSTEP_REQUIRE_GL=1, or what `required_by` names, the skip itself
/// is a failure. Defined by <lockstep/catch_main.hpp>, <lockstep/doctest_main.hpp> or <lockstep/gtest.hpp>.
void skip(const std::string& reason, const std::string& required_by = "LOCKSTEP_REQUIRE_GL");

} // namespace lockstep
