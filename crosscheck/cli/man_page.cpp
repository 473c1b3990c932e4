#include "crosscheck/cli/man_page.hpp"

#include <span>
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
    const std::string initial = option.initial.empty() ? "" : plain(fmt::format(" (default: {})", option.initial));
    return fmt::format(".TP\n{}\n{}{}\n", head, plain(option.description), initial);
}

/// Every line of a footer for itself.
std::string lines_of(const std::string& footer) {
    std::string text;
    std::istringstream stream(footer);
    for (std::string line; std::getline(stream, line);)
        text += fmt::format("{}{}\n", text.empty() ? ".PP\n" : ".br\n", plain(line));
    return text;
}

/// A verb and its parts. `words` call it: "lockstep capsule".
std::string section(const Verb& verb, const std::string& words) {
    std::string text = fmt::format(".SS {}\n{}\n", plain(words), plain(verb.description));
    for (const Option& option : all_options(verb))
        text += option_paragraph(option);
    text += lines_of(verb.footer);
    for (const Verb& part : verb.verbs)
        text += section(part, words + " " + part.name);
    return text;
}

/// Of ENVIRONMENT and FILES: a name, and what it is for.
struct NamedLine {
    const char *name, *meaning;
};

constexpr NamedLine manual_environment[] = {
    {"LOCKSTEP_DATA", "a folder that holds shaders/ and scenes/, instead of the installed one"},
    {"LOCKSTEP_OSMESA_LIBRARY, LOCKSTEP_EGL_LIBRARY", "other builds of these libraries"},
    {"LOCKSTEP_GL", "the context that tests of your own open: auto, osmesa, egl, egl-device:N"},
    {"LOCKSTEP_FILE_MEMORY", "bytes that reading one recording may take"},
    {"NO_COLOR", "if it is set, no colours, on terminals either"},
    {"OMP_NUM_THREADS", "threads of the reference, where --threads says nothing"},
    {"OMP_WAIT_POLICY", "passive, unless it is set: threads that wait leave the cores to the driver"},
};

constexpr NamedLine manual_files[] = {
    {"share/lockstep/scenes", "the scenes that come with lockstep"},
    {"share/lockstep/shaders", "its shaders, which --shaders DIR replaces one by one"},
    {"share/lockstep/report.html", "the page that --report writes data into"},
    {"bindings.json", "beside shaders of your own: what their names are here (docs/own_shader.md)"},
};

constexpr const char* manual_examples[] = {
    "lockstep check data/scenes/x_streams.json --shaders mine --frames 60",
    "lockstep explain data/scenes/x_streams.json --frame 1 --particle 159 --shaders mine",
    "lockstep record data/scenes/lattice.json -o run.h5; lockstep check --trace run.h5",
    "lockstep check --stress --shaders mine --power-at-least 95%",
};

std::string section(const char* title, std::span<const NamedLine> all) {
    std::string text = fmt::format(".SH {}\n", title);
    for (const NamedLine& one : all)
        text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", plain(one.name), plain(one.meaning));
    return text;
}

} // namespace

std::string man_page(const std::string& summary, const std::vector<Verb>& verbs) {
    std::string text = fmt::format(".TH LOCKSTEP 1\n.SH NAME\nlockstep \\- {}\n"
                                   ".SH SYNOPSIS\n\\fBlockstep\\fR \\fIVERB\\fR [\\fIOPTIONS\\fR]\n.SH VERBS\n",
                                   plain(summary));
    for (const Verb& verb : verbs)
        text += section(verb, "lockstep " + verb.name);
    text += ".SH EXIT STATUS\n0 what was asked holds, 1 it does not, 2 could not run, 130 ended by Ctrl\\-C.\n";
    text += section("ENVIRONMENT", manual_environment) + section("FILES", manual_files) + ".SH EXAMPLES\n";
    for (const char* example : manual_examples)
        text += fmt::format(".PP\n{}\n", plain(example));
    return text;
}

} // namespace lockstep
