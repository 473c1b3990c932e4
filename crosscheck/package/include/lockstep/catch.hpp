#pragma once
/// A matcher for Catch2, version 2 or 3 (docs/unit_tests.md):
///
///     CHECK_THAT(gpu, MatchesReference(scene).frames(120));
///
/// and of any other result (of match_system, match_function) LOCKSTEP_CHECK or LOCKSTEP_REQUIRE:
///
///     LOCKSTEP_CHECK(match_system(gpu, system, {.frames = 60}));
///
/// The package itself does not depend on Catch2; who includes this does.
#include <ostream>
#include <sstream>
#include <string>

#include "lockstep/catch2.hpp"
#include "lockstep/matched.hpp"
#include "lockstep/skip.hpp"
#include "lockstep/test_notes.hpp"

namespace lockstep {

/// Names a side in a failed assertion.
inline std::ostream& operator<<(std::ostream& stream, const GpuSide& gpu) { return stream << gpu.describe().name; }

/// Columns of an expansion. Catch2 has 80 for it and its indentation and breaks longer lines anywhere, long paths too,
/// unless CATCH_CONFIG_CONSOLE_WIDTH is defined where its main is; <lockstep/catch_main.hpp> defines 120.
inline constexpr std::size_t expansion_width = 77;

/// The repeat line of an expansion if Catch2 3, whose 80 columns are built in, breaks a word of it; else "".
inline std::string broken_repeat(const std::string& text) {
    const std::size_t begin = text.find("\nrepeat ");
    std::istringstream lines(begin == std::string::npos ? "" : text.substr(begin + 1));
    std::string command;
    bool broken = false, goes_on = true;
    for (std::string line; goes_on && std::getline(lines, line); command += "  " + line + "\n") {
        broken = broken || line.size() > expansion_width;
        goes_on = line.ends_with('\\');
    }
    return broken && CATCH_VERSION_MAJOR >= 3 ? command : "";
}

/// The command that runs the test case at hand alone.
inline std::string this_test_again() {
    std::string name;
    for (const char c : Catch::getResultCapture().getCurrentTestName()) {
        if (c == '\\' || c == ',' || c == '[' || c == '"')
            name += '\\';
        name += c;
    }
    return this_program({name});
}

/// For the JUnit reporter.
inline void note_match(const MatchResult& result) {
    test_notes().verdict = result.verdict();
    test_notes().properties = {
        {"renderer", result.run().context},
        {"profile", result.run().profile},
        {"shaders", result.run().shaders ? shaders_text(*result.run().shaders) : result.run().shaders_untold},
        {"verdict", verdict_words(result.report())},
        {"power", power_words(result.report().power)}};
}

/// Holds a GpuSide against the reference, from the scene's start (match_reference). The scene outlives the matcher.
class MatchesReference : public CatchMatcher<GpuSide> {
  public:
    explicit MatchesReference(const Scene& scene) : scene_(&scene) {}
    explicit MatchesReference(Scene&&) = delete;

    MatchesReference& frames(int count) {
        options_.frames = count;
        return *this;
    }
    MatchesReference& mode(CheckMode mode) {
        options_.mode = mode;
        return *this;
    }
    MatchesReference& legal(Legal legal) {
        options_.legal = legal;
        return *this;
    }
    MatchesReference& allow_undefined() {
        options_.allow_undefined = true;
        return *this;
    }
    MatchesReference& render() {
        options_.render = true;
        return *this;
    }
    MatchesReference& require_hits() {
        options_.require_hits = true;
        return *this;
    }
    MatchesReference& power_at_least(double share) {
        options_.power_at_least = share;
        return *this;
    }

    /// CHECK_THAT hands the side over as const, and it has to run: it is not to be a constant.
    bool match(const GpuSide& gpu) const override {
        MatchOptions options = options_;
        options.repeat = this_test_again();
        const MatchResult result = match_reference(const_cast<GpuSide&>(gpu), *scene_, options);
        text_ = result.passed() ? result.text(expansion_width) : result.failure(expansion_width);
        note_match(result);
        test_notes().repeat = broken_repeat(text_);
        return result.passed();
    }

    std::string describe() const override { return "is to match the reference\n" + text_; }

  private:
    const Scene* scene_;
    MatchOptions options_;
    mutable std::string text_; ///< of the last match
};

} // namespace lockstep

namespace Catch {

template <> struct StringMaker<lockstep::Matched> {
    static std::string convert(const lockstep::Matched& matched) { return matched.text(); }
};

} // namespace Catch

#define LOCKSTEP_CATCH_(assertion, ...)                                                                                \
    do {                                                                                                               \
        const ::lockstep::MatchResult lockstep_result = (__VA_ARGS__);                                                 \
        ::lockstep::note_match(lockstep_result);                                                                       \
        INFO((lockstep_result.passed() ? "" : lockstep_result.failure(::lockstep::expansion_width)));                  \
        assertion(::lockstep::Matched(lockstep_result));                                                               \
    } while (false)
#define LOCKSTEP_CHECK(...) LOCKSTEP_CATCH_(CHECK, __VA_ARGS__)
#define LOCKSTEP_REQUIRE(...) LOCKSTEP_CATCH_(REQUIRE, __VA_ARGS__)
