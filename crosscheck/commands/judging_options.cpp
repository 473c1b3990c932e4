#include "crosscheck/commands/judging_options.hpp"

#include "crosscheck/commands/option_values.hpp"

namespace lockstep {

void add_legal_option(CLI::App& verb, Legal& legal) {
    add_choice<Legal>(verb, "--legal", legal,
                      {{"measured", Legal::measured}, {"glsl", Legal::glsl}, {"any_order", Legal::any_order}},
                      "what differences are judged by: what the driver was measured to do; GLSL's precision rules; "
                      "these for shaders without `precise`");
}

KnownOperations known_operations(Legal legal, const Profile& profile) {
    return legal == Legal::measured ? measured_operations(profile) : KnownOperations{.sums = legal == Legal::glsl};
}

std::string legal_option_text(Legal legal) {
    if (legal == Legal::measured)
        return "";
    return legal == Legal::glsl ? " --legal glsl" : " --legal any_order";
}

} // namespace lockstep
