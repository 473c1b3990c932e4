#pragma once
#include <lockstep/skip.hpp>

namespace lockstep::test {

/// Ends the running test case early because the machine lacks something (a GL context, a mesh). Use as
/// `if (!context) return skip("no OSMesa: ...");` in a void test case.
using lockstep::skip;

} // namespace lockstep::test
