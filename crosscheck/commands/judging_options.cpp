#include "crosscheck/commands/judging_options.hpp"

#include "crosscheck/commands/option_values.hpp"

namespace lockstep {

void add_legal_option(CLI::App& verb, Legal& legal) {
    add_choice<Legal>(verb, "--legal", legal,
                      {{"measured", Legal::measured}, {"glsl", Legal::glsl}, {"any_order", Legal::any_order}},
                      "what differences are judged by: what the driver was measured to do; GLSL's precision rules; "
                      "these for shaders without `precise`");
}

} // namespace lockstep
