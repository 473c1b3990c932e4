#include <functional>
#include <memory>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/completion.hpp"
#include "crosscheck/cli/man_page.hpp"
#include "crosscheck/command/option_values.hpp"

namespace lockstep {

Verb completion_command() {
    using Writer = std::function<std::string(const std::vector<Verb>&)>;
    auto writer = std::make_shared<Writer>();
    Verb verb{"completion", "write the completion of a shell to standard output"};
    verb.add(required(choice_option<Writer>(
        "shell", *writer, {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}},
        "the shell it is for")));
    verb.footer = "In the shell's own file (.bashrc, .zshrc): source <(lockstep completion bash)\n"
                  "Example: lockstep completion fish > ~/.config/fish/completions/lockstep.fish";
    verb.run = [writer](const Call& call) {
        fmt::print("{}", (*writer)(call.program.verbs));
        return status_agree;
    };
    return verb;
}

Verb manual_command() {
    Verb verb{"manual", "write the manual page to standard output"};
    verb.footer = "Example: lockstep manual | man -l -";
    verb.run = [](const Call& call) {
        fmt::print("{}",
                   man_page("runs an image-based particle system as plain C++ and as GLSL on OpenGL, and compares "
                            "every bit of every frame",
                            call.program.verbs));
        return status_agree;
    };
    return verb;
}

} // namespace lockstep
