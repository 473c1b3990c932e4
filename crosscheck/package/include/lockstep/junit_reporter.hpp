#pragma once
/// A reporter for Catch2 v2, `--reporter lockstep-junit --out FILE`: JUnit as the one Catch2 has, one test case an
/// entry, with pass, fail and skipped apart and renderer, profile and verdict as properties, of each test case and of
/// all. <lockstep/catch_main.hpp> includes it.
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "lockstep/test_notes.hpp"

namespace lockstep {

class JUnitReporter : public Catch::StreamingReporterBase<JUnitReporter> {
  public:
    explicit JUnitReporter(const Catch::ReporterConfig& config) : StreamingReporterBase(config) {
        m_reporterPrefs.shouldRedirectStdOut = true;
    }
    static std::string getDescription() { return "JUnit with skipped tests, renderer and profile"; }

    void assertionStarting(const Catch::AssertionInfo& /*info*/) override {}

    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        StreamingReporterBase::testCaseStarting(info);
        test_notes() = {};
        problem_.reset();
        timer_.start();
    }

    /// The first that failed is told, the rest are counted.
    bool assertionEnded(const Catch::AssertionStats& stats) override {
        const Catch::AssertionResult& result = stats.assertionResult;
        if (!result.isOk() && !problem_)
            problem_ = Problem{result.getResultType() == Catch::ResultWas::ThrewException ||
                                   result.getResultType() == Catch::ResultWas::FatalErrorCondition,
                               result.hasExpression() ? result.getExpression() : std::string(result.getMessage()),
                               failure_text(stats)};
        return true;
    }

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        cases_.push_back({stats.testInfo.name, stats.stdOut, timer_.getElapsedSeconds(),
                          stats.totals.assertions.allOk() ? std::optional<Problem>() : problem_, test_notes()});
        StreamingReporterBase::testCaseEnded(stats);
    }

    void testRunEnded(const Catch::TestRunStats& stats) override {
        Catch::XmlWriter xml(stream);
        const auto suites = xml.scopedElement("testsuites");
        const auto suite = xml.scopedElement("testsuite");
        const std::string program = stats.runInfo.name;
        xml.writeAttribute("name", program);
        write_totals(xml);
        write_properties(xml, all_properties());
        for (const Case& test : cases_)
            write_case(xml, program, test);
        StreamingReporterBase::testRunEnded(stats);
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
