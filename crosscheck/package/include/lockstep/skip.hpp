#pragma once
#include <string>

namespace lockstep {

/// Tells that the running test case cannot be run here (no GL context), and why: `if (!gl) return skip(gl.missing());`.
/// The program then ends with 77, which CTest shows as skipped (SKIP_RETURN_CODE 77), unless a test fails; with
/// LOCKSTEP_REQUIRE_GL=1, or what `required_by` names, the skip itself is a failure. Defined by
/// <lockstep/catch_main.hpp>.
void skip(const std::string& reason, const std::string& required_by = "LOCKSTEP_REQUIRE_GL");

} // namespace lockstep
