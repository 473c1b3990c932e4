#include "crosscheck/report/junit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"

namespace lockstep {
namespace {

std::string escaped(const std::string& text) {
    std::string xml;
    for (const char c : plain_text(text))
        switch (c) {
        case '&':
            xml += "&amp;";
            break;
        case '<':
            xml += "&lt;";
            break;
        case '>':
            xml += "&gt;";
            break;
        case '"':
            xml += "&quot;";
            break;
        default:
            xml += c;
        }
    return xml;
}

} // namespace

std::string junit_text(const CheckReport& report, const RunDescription& run, bool passes, const InputDigests& inputs) {
    const int failures = passes ? 0 : 1;
    std::string xml = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                                  "<testsuites tests=\"1\" failures=\"{0}\">\n"
                                  "  <testsuite name=\"lockstep check\" tests=\"1\" failures=\"{0}\" errors=\"0\" "
                                  "skipped=\"0\">\n"
                                  "    <properties>\n",
                                  failures);
    const std::pair<const char*, std::string> properties[] = {{"renderer", run.context},
                                                              {"profile", run.profile},
                                                              {"shaders", shaders_line(run)},
                                                              {"inputs", inputs.empty() ? "" : inputs_text(inputs)},
                                                              {"verdict", verdict_words(report)}};
    for (const auto& [name, value] : properties)
        if (!value.empty())
            xml += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", name, escaped(value));
    xml += fmt::format("    </properties>\n    <testcase classname=\"lockstep.check\" name=\"{}\"", escaped(run.scene));
    std::string inside;
    if (!passes)
        inside = fmt::format("      <failure message=\"{}\">{}</failure>\n", escaped(verdict_words(report)),
                             escaped(report_text(report, run)));
    if (!run.notes.empty())
        inside +=
            fmt::format("      <system-out>{}</system-out>\n", escaped(fmt::format("{}", fmt::join(run.notes, "\n"))));
    xml += inside.empty() ? "/>\n" : fmt::format(">\n{}    </testcase>\n", inside);
    return xml + "  </testsuite>\n</testsuites>\n";
}

} // namespace lockstep
