#include "crosscheck/cli/judging_options.hpp"

#include "crosscheck/cli/option_values.hpp"

namespace lockstep {

void add_legal_option(CLI::App& verb, Legal& legal) {
    add_choice<Legal>(verb, "--legal", legal,
                      {{"measured", Legal::measured}, {"glsl", Legal::glsl}, {"any_order", Legal::any_order}},
                      "what differences are judged by: what the driver was measured to do; GLSL's precision rules; "
                      "these for shaders without `precise`");
}

void add_pass_options(CLI::App& verb, PassRules& rules) {
    verb.add_flag("--allow-undefined", rules.allow_undefined, "do not fail on what rests on what GL leaves open");
    verb.add_flag("--require-hits", rules.require_hits, "fail where nothing collided, so that little was tried");
}

} // namespace lockstep
