#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "crosscheck/commands/commands.hpp"
#include "crosscheck/commands/judging_options.hpp"
#include "crosscheck/commands/option_values.hpp"
#include "crosscheck/commands/run_options.hpp"
#include "crosscheck/explain_text.hpp"
#include "crosscheck/frame_run.hpp"
#include "crosscheck/places.hpp"
#include "crosscheck/profiles.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct Options {
    RunOptions run;
    int frame = 0;
    std::optional<std::string> particle, texel;
    Legal legal = Legal::measured;
    bool hexadecimal = false;
};

int run(const Options& options) {
    if (options.particle.has_value() == options.texel.has_value())
        throw Error("explain: either --particle I or --texel X,Y is needed");
    Scene scene = load(options.run);
    const std::size_t item =
        options.particle ? particle_named(*options.particle, scene) : texel_named(*options.texel, scene);
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context);
    FrameRun frames(std::move(scene), profile, known_operations(options.legal, profile), options.run.shaders);
    frames.go_to(options.frame);
    const NumberFormat format = options.hexadecimal ? NumberFormat::hexadecimal : NumberFormat::decimal;
    fmt::print("scene     {} ({})\nswitches  {}\nGL        {}\nprofile   {}\n\n", frames.scene().name,
               options.run.scene.string(), settings_text(options.run, frames.scene()), summary(context.describe()),
               describe(profile));
    fmt::print("{}", options.texel ? explain_texel(frames, item, format) : explain_particle(frames, item, format));
    return status_agree;
}

} // namespace

void add_explain_command(CLI::App& app, int& status) {
    auto options = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand("explain", "both sides of one particle or texel in one frame, step by step");
    add_scene_options(*verb, options->run);
    add_gl_options(*verb, options->run);
    verb->add_option("--frame", options->frame, "the frame, counted from 0")
        ->required()
        ->check(integer(0, most_frames))
        ->type_name("F");
    verb->add_option("--particle", options->particle, "the particle")->type_name("I");
    verb->add_option("--texel", options->texel, "the texel of the CDT, column and row from the bottom left")
        ->type_name("X,Y");
    add_legal_option(*verb, options->legal);
    verb->add_flag("--hex", options->hexadecimal, "hexadecimal floats instead of decimal ones");
    verb->footer("Exit status: 0 told, 2 could not run.\n"
                 "Example: lockstep explain data/scenes/lattice.json --frame 30 --particle 17");
    verb->callback([options, &status] { status = run(*options); });
}

} // namespace lockstep
