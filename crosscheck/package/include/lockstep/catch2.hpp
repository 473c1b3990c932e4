#pragma once
/// Catch2 as it is here: version 3, or version 2 where it was included before or is all there is. catch2_v3 names what
/// moved between them.
#if !defined(CATCH_VERSION_MAJOR) && __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_test_macros.hpp>
#include <catch2/catch_version_macros.hpp>
#include <catch2/interfaces/catch_interfaces_capture.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#else
#include <catch2/catch.hpp>
#endif

namespace lockstep {

#if CATCH_VERSION_MAJOR >= 3
template <class Value> using CatchMatcher = Catch::Matchers::MatcherBase<Value>;
#else
template <class Value> using CatchMatcher = Catch::MatcherBase<Value>;
#endif

} // namespace lockstep
