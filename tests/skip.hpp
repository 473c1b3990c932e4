#pragma once
#include <string>

namespace lockstep::test {

/// Ends the running test case early because the machine lacks something (a GL context, a mesh). The program then ends
/// with 77, which CTest shows as "Skipped"; with LOCKSTEP_REQUIRE_GL=1 it is a failure instead. Use as
/// `if (!context) return skip("no OSMesa: ...");` in a void test case.
void skip(const std::string& reason);

} // namespace lockstep::test
