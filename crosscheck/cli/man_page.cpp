#include "crosscheck/cli/man_page.hpp"

#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lockstep {
namespace {

/// Text in which man finds no requests of its own.
std::string plain(const std::string& text) {
    std::string result;
    bool line_start = true;
    for (const char c : text) {
        if (line_start && (c == '.' || c == '\''))
            result += "\\&";
        result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
        line_start = c == '\n';
    }
    return result;
}

std::string option_paragraph(const Option& option) {
    std::string head = fmt::format("\\fB{}\\fR", plain(fmt::format("{}", fmt::join(names(option), ", "))));
    if (!option.value.empty() && !is_argument(option))
        head += fmt::format(" \\fI{}\\fR", plain(option.value));
    return fmt::format(".TP\n{}\n{}\n", head, plain(option.description));
}

/// Every line of a footer for itself.
std::string lines_of(const std::string& footer) {
    std::string text;
    std::istringstream stream(footer);
    for (std::string line; std::getline(stream, line);)
        text += fmt::format("{}{}\n", text.empty() ? ".PP\n" : ".br\n", plain(line));
    return text;
}

std::string section(const Verb& verb) {
    std::string text = fmt::format(".SS lockstep {}\n{}\n", plain(verb.name), plain(verb.description));
    for (const Option& option : all_options(verb))
        text += option_paragraph(option);
    return text + lines_of(verb.footer);
}

} // namespace

std::string man_page(const std::string& summary, const std::vector<Verb>& verbs) {
    std::string text = fmt::format(".TH LOCKSTEP 1\n.SH NAME\nlockstep \\- {}\n"
                                   ".SH SYNOPSIS\n\\fBlockstep\\fR \\fIVERB\\fR [\\fIOPTIONS\\fR]\n.SH VERBS\n",
                                   plain(summary));
    for (const Verb& verb : verbs)
        text += section(verb);
    return text +
           ".SH ENVIRONMENT\n"
           ".TP\n\\fBLOCKSTEP_OSMESA_LIBRARY\\fR, \\fBLOCKSTEP_EGL_LIBRARY\\fR\nother builds of these libraries\n"
           ".TP\n\\fBLOCKSTEP_DATA\\fR\na folder that holds shaders/ and scenes/, instead of the installed one\n";
}

} // namespace lockstep
