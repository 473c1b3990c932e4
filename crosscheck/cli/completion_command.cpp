#include <cstdio>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/completion.hpp"
#include "crosscheck/cli/man_page.hpp"
#include "crosscheck/cli/option_values.hpp"

namespace lockstep {

void add_completion_command(CLI::App& app, int& status) {
    using Writer = std::function<std::string(const std::vector<VerbText>&)>;
    auto writer = std::make_shared<Writer>();
    CLI::App* verb = app.add_subcommand("completion", "write the completion of a shell to standard output");
    add_choice<Writer>(*verb, "shell", *writer,
                       {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}},
                       "the shell it is for")
        ->required();
    verb->footer("In the shell's own file (.bashrc, .zshrc): source <(lockstep completion bash)\n"
                 "Example: lockstep completion fish > ~/.config/fish/completions/lockstep.fish");
    verb->callback([&app, &status, writer] {
        fmt::print("{}", (*writer)(verb_texts(app)));
        status = status_agree;
    });
}

void add_manual_command(CLI::App& app, int& status) {
    CLI::App* verb = app.add_subcommand("manual", "write the manual page to standard output");
    verb->footer("Example: lockstep manual | man -l -");
    verb->callback([&app, &status] {
        fmt::print("{}",
                   man_page("runs an image-based particle system as plain C++ and as GLSL on OpenGL, and compares "
                            "every bit of every frame",
                            verb_texts(app)));
        status = status_agree;
    });
}

} // namespace lockstep
