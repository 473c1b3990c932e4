#include "crosscheck/command/judging_options.hpp"

#include "crosscheck/command/option_values.hpp"
#include "gpu/shader_warnings.hpp"

namespace lockstep {

void add_legal_option(Verb& verb, Legal& legal) {
    verb.add(choice_option<Legal>(
        "--legal", legal,
        {{"by_text", Legal::by_text},
         {"measured", Legal::measured},
         {"glsl", Legal::glsl},
         {"any_order", Legal::any_order}},
        "what differences are judged by: what the driver was measured to do, and what a shader's text without "
        "`precise` leaves open; the first alone; GLSL's precision rules; any order of operations too"));
}

void add_pass_options(Verb& verb, PassRules& rules) {
    verb.add(flag("--allow-undefined", rules.allow_undefined, "do not fail on what GL leaves open"));
    verb.add(flag("--require-hits", rules.require_hits, "fail where nothing collided, so that little was tried"));
    verb.add(share_option("--power-at-least", rules.power_at_least,
                          "fail where the run would have shown fewer of the mistakes with names: 95%, 0.95"));
}

void add_cover_option(Verb& verb, PassRules& rules) {
    verb.add(share_option("--cover-at-least", rules.cover_at_least,
                          "fail where fewer of the lines and branch sides of the shaders' texts were run, in all "
                          "frames as far as that is quick: 95%, 0.95"));
}

void add_werror_option(Verb& verb) {
    verb.add(flag("--werror-shaders", shader_warnings_are_errors(),
                  "stop where the driver warns of a shader, as of a variable that is never set, and fail where its "
                  "text does what GLSL gives no result for"));
}

std::string werror_option_text() { return shader_warnings_are_errors() ? " --werror-shaders" : ""; }

} // namespace lockstep
