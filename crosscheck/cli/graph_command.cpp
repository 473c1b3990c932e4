#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/judge/graph_system.hpp"
#include "crosscheck/report/colour.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/scene/graph_catalogue.hpp"
#include "crosscheck/scene/graph_file.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/graph_glsl.hpp"
#include "lockstep/system.hpp"

namespace lockstep {
namespace {

struct GraphRequest {
    std::filesystem::path file;
    std::size_t items = 4096, item = 0, seed = 1;
    bool exact = false, quiet = false;
    std::string gl = "auto";
    Legal legal = Legal::by_text;
};

GraphPtr graph_of(const GraphRequest& options) { return std::make_shared<const Graph>(load_graph(options.file)); }

int check_graph(const GraphRequest& options) {
    const GraphPtr graph = graph_of(options);
    const ArithmeticSwitch arithmetic = options.exact ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    const SystemScene scene =
        graph_system(graph, plain_line(options.file.stem().string()), options.items, options.seed, arithmetic);
    RunOptions run;
    run.gl = options.gl;
    const Gl gl = open_gl(run);
    GlSystemSide side = side_of(gl, scene, run);
    CheckOptions how;
    how.frames = 1;
    how.known = known_operations(options.legal, side.describe().profile);
    CheckReport report = check(scene.system, side, how);
    note_unset_variables(report, side.describe().warnings);
    if (!options.quiet) {
        RunDescription about = describe_run(scene.system, side.describe(), how,
                                            fmt::format("lockstep graph check {} --items {} --seed {}{}{}",
                                                        shell_word(options.file.string()), options.items, options.seed,
                                                        options.exact ? " --exact" : "", werror_option_text()));
        about.scene = fmt::format("{} ({})", scene.system.name, plain_line(options.file.string()));
        fmt::print("{}", colored(plain_text(report_text(report, about))));
    }
    return passes(report) ? status_agree : status_differ;
}

int print_glsl(const GraphRequest& options) {
    for (const auto& [name, text] : graph_texts(*graph_of(options)))
        fmt::print("// {}\n{}", name, text);
    return status_agree;
}

int print_values(const GraphRequest& options) {
    fmt::print("{}", graph_values(graph_of(options), options.item, options.seed));
    return status_agree;
}

/// What an editor knows of graphs.
Verb nodes_verb() {
    Verb verb("nodes", "print what graphs are made of, for an editor: stages, types of nodes, ports, as JSON");
    verb.footer = "Example: lockstep graph nodes";
    verb.run = [](const Call&) {
        fmt::print("{}", graph_catalogue());
        return status_agree;
    };
    return verb;
}

Verb of_graph(std::string name, std::string description, const std::shared_ptr<GraphRequest>& options,
              int (*run)(const GraphRequest&)) {
    Verb verb(std::move(name), std::move(description));
    Option file = path_option("graph", "FILE", options->file, "the graph, JSON (docs/graphs.md)");
    file.required = true;
    verb.add(std::move(file));
    verb.footer = "Exit status: 0 it agrees or is legal, 1 it is not, 2 the graph is wrong or could not run.\n"
                  "Example: lockstep graph check data/graphs/fire.json";
    verb.run = [options, run](const Call&) { return run(*options); };
    return verb;
}

} // namespace

Verb graph_command() {
    auto options = std::make_shared<GraphRequest>();
    const auto seed = [&] {
        return integer_option("--seed", "S", {0, 1'000'000'000}, options->seed, "of the inputs that are made up");
    };
    Verb check_verb =
        of_graph("check", "run it as GLSL and by its interpreter, and compare what they make", options, check_graph);
    check_verb.add(integer_option("--items", "N", {1, 1 << 22}, options->items, "invocations"));
    check_verb.add(seed());
    check_verb.add(flag("--exact", options->exact, "with arithmetic that has the same bits everywhere"));
    check_verb.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", options->gl, "which GL to open"));
    add_legal_option(check_verb, options->legal);
    add_werror_option(check_verb);
    check_verb.add(flag("--quiet", options->quiet, "print nothing"));
    Verb eval = of_graph("eval", "print what each node makes, in hexadecimal; needs no GL", options, print_values);
    eval.add(integer_option("--item", "I", {0, (1 << 22) - 1}, options->item, "which of the invocations of a check"));
    eval.add(seed());
    Verb verb{"graph", "check a graph of nodes, which says how particles behave"};
    verb.footer = "Example: lockstep graph check data/graphs/fire.json";
    verb.verbs = {std::move(check_verb), of_graph("glsl", "print the shader that it becomes", options, print_glsl),
                  std::move(eval), nodes_verb()};
    return verb;
}

} // namespace lockstep
