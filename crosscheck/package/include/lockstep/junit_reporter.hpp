#pragma once
/// A reporter for Catch2, version 2 or 3, `--reporter lockstep-junit --out FILE`: JUnit as the one Catch2 has, one test
/// case an entry, with pass, fail and skipped apart and renderer, profile and verdict as properties, of each test case
/// and of all. <lockstep/catch_main.hpp> includes it.
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "lockstep/catch2.hpp"
#include "lockstep/test_notes.hpp"
#if CATCH_VERSION_MAJOR >= 3
#include <catch2/catch_test_case_info.hpp>
#include <catch2/catch_timer.hpp>
#include <catch2/internal/catch_xmlwriter.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
#include <catch2/reporters/catch_reporter_streaming_base.hpp>
#endif

namespace lockstep {

/// What a reporter of either version derives from, under one set of names.
#if CATCH_VERSION_MAJOR >= 3
class CatchReporter : public Catch::StreamingReporterBase {
  public:
    explicit CatchReporter(Catch::ReporterConfig&& config) : StreamingReporterBase(std::move(config)) {
        m_preferences.shouldRedirectStdOut = true;
    }
    void assertionEnded(const Catch::AssertionStats& stats) override { note(stats); }

  protected:
    virtual void note(const Catch::AssertionStats& stats) = 0;
    [[nodiscard]] std::ostream& out() { return m_stream; }
    static std::string name_of(const Catch::TestCaseStats& stats) { return stats.testInfo->name; }
};
#else
class CatchReporter : public Catch::StreamingReporterBase<CatchReporter> {
  public:
    explicit CatchReporter(const Catch::ReporterConfig& config) : StreamingReporterBase(config) {
        m_reporterPrefs.shouldRedirectStdOut = true;
    }
    void assertionStarting(const Catch::AssertionInfo& /*info*/) override {}
    bool assertionEnded(const Catch::AssertionStats& stats) override {
        note(stats);
        return true;
    }

  protected:
    virtual void note(const Catch::AssertionStats& stats) = 0;
    [[nodiscard]] std::ostream& out() { return stream; }
    static std::string name_of(const Catch::TestCaseStats& stats) { return stats.testInfo.name; }
};
#endif

class JUnitReporter : public CatchReporter {
  public:
    using CatchReporter::CatchReporter;
    static std::string getDescription() { return "JUnit with skipped tests, renderer and profile"; }

    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        CatchReporter::testCaseStarting(info);
        test_notes() = {};
        problem_.reset();
        timer_.start();
    }

    /// The first that failed is told, the rest are counted.
    void note(const Catch::AssertionStats& stats) override {
        const Catch::AssertionResult& result = stats.assertionResult;
        if (!result.isOk() && !problem_)
            problem_ = Problem{result.getResultType() == Catch::ResultWas::ThrewException ||
                                   result.getResultType() == Catch::ResultWas::FatalErrorCondition,
                               message_of(result), failure_text(stats)};
    }

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        cases_.push_back({name_of(stats), stats.stdOut, timer_.getElapsedSeconds(),
                          stats.totals.assertions.allOk() ? std::optional<Problem>() : problem_, test_notes()});
        CatchReporter::testCaseEnded(stats);
    }

    void testRunEnded(const Catch::TestRunStats& stats) override {
        Catch::XmlWriter xml(out());
        const auto suites = xml.scopedElement("testsuites");
        const auto suite = xml.scopedElement("testsuite");
        const std::string program(stats.runInfo.name);
        xml.writeAttribute("name", program);
        write_totals(xml);
        write_properties(xml, all_properties());
        for (const Case& test : cases_)
            write_case(xml, program, test);
        CatchReporter::testRunEnded(stats);
    }

  private:
    struct Problem {
        bool error = false; ///< an exception, not an assertion
        std::string message;
        std::string text;
    };
    struct Case {
        std::string name;
        std::string output;
        double seconds = 0.0;
        std::optional<Problem> problem;
        TestNotes notes;
        [[nodiscard]] bool skipped() const { return !problem && !notes.skipped.empty(); }
    };
    using Properties = std::map<std::string, std::string>;

    /// The verdict where a match failed.
    static std::string message_of(const Catch::AssertionResult& result) {
        if (!result.hasExpression())
            return std::string(result.getMessage());
        const std::string expanded = result.getExpandedExpression();
        const std::string& verdict = test_notes().verdict;
        const bool is_match = !verdict.empty() &&
                              (expanded == verdict || expanded.find("is to match the reference") != std::string::npos);
        return is_match ? verdict : result.getExpression();
    }

    static std::string failure_text(const Catch::AssertionStats& stats) {
        const Catch::AssertionResult& result = stats.assertionResult;
        std::ostringstream text;
        text << result.getSourceInfo() << '\n';
        if (result.hasExpression())
            text << result.getExpressionInMacro() << '\n';
        if (result.hasExpandedExpression())
            text << result.getExpandedExpression() << '\n';
        for (const Catch::MessageInfo& message : stats.infoMessages)
            text << message.message << '\n';
        return text.str();
    }

    [[nodiscard]] Properties all_properties() const {
        std::map<std::string, std::set<std::string>> values;
        for (const Case& test : cases_)
            for (const auto& [name, value] : test.notes.properties)
                values[name].insert(value);
        Properties joined;
        for (const auto& [name, all] : values)
            for (const std::string& value : all)
                joined[name] += (joined[name].empty() ? "" : "; ") + value;
        return joined;
    }

    void write_totals(Catch::XmlWriter& xml) const {
        int failures = 0;
        int errors = 0;
        int skipped = 0;
        double seconds = 0.0;
        for (const Case& test : cases_) {
            failures += test.problem && !test.problem->error ? 1 : 0;
            errors += test.problem && test.problem->error ? 1 : 0;
            skipped += test.skipped() ? 1 : 0;
            seconds += test.seconds;
        }
        xml.writeAttribute("tests", cases_.size());
        xml.writeAttribute("failures", failures);
        xml.writeAttribute("errors", errors);
        xml.writeAttribute("skipped", skipped);
        xml.writeAttribute("time", seconds);
    }

    static void write_properties(Catch::XmlWriter& xml, const Properties& properties) {
        if (properties.empty())
            return;
        const auto element = xml.scopedElement("properties");
        for (const auto& [name, value] : properties)
            xml.scopedElement("property").writeAttribute("name", name).writeAttribute("value", value);
    }

    static void write_case(Catch::XmlWriter& xml, const std::string& program, const Case& test) {
        const auto element = xml.scopedElement("testcase");
        xml.writeAttribute("classname", program);
        xml.writeAttribute("name", test.name);
        xml.writeAttribute("time", test.seconds);
        write_properties(xml, test.notes.properties);
        if (test.problem)
            xml.scopedElement(test.problem->error ? "error" : "failure")
                .writeAttribute("message", test.problem->message)
                .writeText(test.problem->text, Catch::XmlFormatting::Newline);
        else if (test.skipped())
            xml.scopedElement("skipped").writeAttribute("message", test.notes.skipped);
        if (!test.output.empty())
            xml.scopedElement("system-out").writeText(test.output, Catch::XmlFormatting::Newline);
    }

    Catch::Timer timer_;
    std::optional<Problem> problem_;
    std::vector<Case> cases_;
};

CATCH_REGISTER_REPORTER("lockstep-junit", JUnitReporter)

} // namespace lockstep
