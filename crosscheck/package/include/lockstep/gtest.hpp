#pragma once
/// For GoogleTest (docs/unit_tests.md):
///
///     LOCKSTEP_CHECK(match_reference(gpu, scene, {.frames = 120}));
///
/// LOCKSTEP_REQUIRE ends the test. A failed one shows verdict, cause, first difference and the command that repeats it,
/// then the rest of the report; renderer, profile and verdict are properties of the test in its XML. The package itself
/// does not depend on GoogleTest; who includes this does.
#include <string>

#include <gtest/gtest.h>

#include "lockstep/lockstep.hpp"
#include "lockstep/skip.hpp"

namespace lockstep {

/// GoogleTest's SKIPPED, which CTest shows as skipped: `if (!gl) return skip(gl.missing());`.
inline void skip(const std::string& reason, const std::string& required_by) {
    if (is_required(required_by))
        FAIL() << required_by << " is set, but " << reason;
    GTEST_SKIP() << reason;
}

namespace gtest {

/// A predicate for EXPECT_PRED_FORMAT1.
inline ::testing::AssertionResult matched(const char* /*expression*/, const MatchResult& result) {
    ::testing::Test::RecordProperty("renderer", result.run().context);
    ::testing::Test::RecordProperty("profile", result.run().profile);
    ::testing::Test::RecordProperty("verdict", verdict_words(result.report()));
    if (result.passed())
        return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << result.verdict() << "\n\n" << result.failure();
}

} // namespace gtest
} // namespace lockstep

#define LOCKSTEP_CHECK(...) EXPECT_PRED_FORMAT1(::lockstep::gtest::matched, (__VA_ARGS__))
#define LOCKSTEP_REQUIRE(...) ASSERT_PRED_FORMAT1(::lockstep::gtest::matched, (__VA_ARGS__))
