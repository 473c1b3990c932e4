#pragma once
/// For doctest (docs/unit_tests.md):
///
///     LOCKSTEP_CHECK(match_reference(gpu, scene, {.frames = 120}));
///
/// LOCKSTEP_REQUIRE ends the test case. A failed one shows its verdict, which is the message in JUnit, too, then cause,
/// first difference and the command that repeats it, and the rest of the report. The package itself does not depend on
/// doctest; who includes this does.
#include <doctest/doctest.h>

#include "lockstep/matched.hpp"
#include "lockstep/skip.hpp"

namespace doctest {

template <> struct StringMaker<lockstep::Matched> {
    static String convert(const lockstep::Matched& matched) { return matched.text().c_str(); }
};

} // namespace doctest

#define LOCKSTEP_DOCTEST_(assertion, ...)                                                                              \
    do {                                                                                                               \
        const ::lockstep::MatchResult lockstep_result = (__VA_ARGS__);                                                 \
        const std::string lockstep_failure = lockstep_result.passed() ? "" : lockstep_result.failure();                \
        DOCTEST_INFO(lockstep_failure);                                                                                \
        assertion(::lockstep::Matched(lockstep_result));                                                               \
    } while (false)
#define LOCKSTEP_CHECK(...) LOCKSTEP_DOCTEST_(DOCTEST_CHECK, __VA_ARGS__)
#define LOCKSTEP_REQUIRE(...) LOCKSTEP_DOCTEST_(DOCTEST_REQUIRE, __VA_ARGS__)
