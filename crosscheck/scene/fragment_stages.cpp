#include "crosscheck/scene/fragment_stages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "crosscheck/scene/profiles.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/written_texels.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "reference/paired_rows.hpp"

namespace lockstep {
namespace {

constexpr std::array<std::string_view, 3> encoders{"encode_position", "half_round", "unorm8_code"};
constexpr std::array<std::string_view, 3> packers{"packHalf2x16", "packUnorm4x8", "packUnorm2x16"};

bool is_among(const auto& words, std::string_view word) { return std::ranges::find(words, word) != words.end(); }

/// Finds declarations of inputs that are not flat: "in vec3 v_Position;", or a block of such.
class InputDeclarations {
  public:
    void add(std::string_view token) {
        if (token == "(" || token == ")")
            parentheses_ += token == "(" ? 1 : -1;
        else if (token == "{" || token == "}")
            braces_ += token == "{" ? 1 : -1;
        // "layout(early_fragment_tests) in;" declares none.
        is_input_ =
            (is_input_ && !(before_ == "in" && token == ";")) || (token == "in" && parentheses_ == 0 && braces_ == 0);
        before_ = token;
        is_flat_ = is_flat_ || token == "flat" || token == "gl_FragCoord";
        if (braces_ > 0 || (token != ";" && token != "}"))
            return;
        found_ = found_ || (is_input_ && !is_flat_);
        is_input_ = is_flat_ = false;
    }
    [[nodiscard]] bool found() const { return found_; }

  private:
    std::string before_;
    int parentheses_ = 0, braces_ = 0;
    bool is_input_ = false, is_flat_ = false, found_ = false;
};

/// Whether what was drawn are codes of the format, all but one in a hundred of its components.
bool are_codes(const CollisionImage& written, CdtFormat format) {
    const auto is_code = [&](float x) {
        return format == CdtFormat::rgba16f ? (std::bit_cast<std::uint32_t>(x) & 0x1fffU) == 0
                                            : std::abs(x * 255.0F - std::nearbyint(x * 255.0F)) < 0x1p-12F;
    };
    std::size_t drawn = 0, codes = 0;
    for (const glm::vec4& texel : written.texels)
        for (int c = 0; c < 3 && texel.w != 0.0F; ++c) {
            ++drawn;
            codes += is_code(texel[c]) ? 1 : 0;
        }
    return drawn >= 24 && 100 * (drawn - codes) <= drawn;
}

/// `rows` rule out nothing any more.
void open(Profile& profile, const PairedRows& rows) {
    std::erase_if(profile.not_followed,
                  [&](const std::string& row) { return row == rows.first || row == rows.second; });
}

} // namespace

FragmentStage fragment_stage(const std::filesystem::path& shaders, std::string_view pass) {
    if (shaders.empty())
        return {};
    const ShaderSource source = load_stage(collision_shaders(shaders), pass, Stage::fragment);
    FragmentStage stage{.encodes = false};
    ShaderWords words(source.text);
    InputDeclarations inputs;
    while (words.next()) {
        inputs.add(words.token());
        stage.packs = stage.packs || is_among(packers, words.token());
        if (!is_among(encoders, words.token()))
            continue;
        const std::size_t file = source.origins.at(words.line() - 1).file;
        if (std::filesystem::path(source.files.at(file)).filename() != "collision_code.glsl")
            stage.encodes = true;
    }
    stage.interpolates = inputs.found();
    return stage;
}

Profile with_written_codes(Profile profile, const Scene& scene, const std::filesystem::path& shaders) {
    const Switches& switches = scene.switches;
    if (shaders.empty() || switches.cdt_format == CdtFormat::rgba32f || switches.search != Search::cdt ||
        has_remedies(switches))
        return profile;
    const PairedRows& rows = switches.cdt_format == CdtFormat::rgba16f ? drawn_half_rows : drawn_unorm8_rows;
    bool packs = false, rounds = false;
    const auto look = [&](bool& converts, std::string_view pass, const auto& written) {
        const FragmentStage stage = fragment_stage(shaders, pass);
        converts = !stage.encodes;
        if (stage.encodes)
            return;
        packs = packs || stage.packs;
        if (stage.packs || !are_codes(written(), switches.cdt_format))
            return;
        // The place of a position among codes of 8 bits is the stage's own sum; which code is nearest stays a tie.
        rounds = true;
        converts = switches.cdt_format == CdtFormat::rgba8;
    };
    try {
        if (switches.step == Step::compute)
            look(profile.converts.particles, "collision_texels", [] { return CollisionImage(); });
        else
            look(profile.converts.particles, "collision_pass", [&] { return written_particles(scene, shaders); });
        const auto obstacles = [&] { return written_obstacles(scene, shaders); };
        if (switches.obstacles_in_cdt == ObstaclesInCdt::triangles)
            look(profile.converts.triangles, "obstacle_pass", obstacles);
        else if (switches.obstacles_in_cdt == ObstaclesInCdt::vertices)
            look(profile.converts.vertices, "obstacle_vertices", obstacles);
    } catch (const Error&) {
        return profile; // the run itself says what is wrong
    }
    if (packs)
        open(profile, rows);
    else if (rounds && switches.cdt_format == CdtFormat::rgba8) {
        open(profile, rows);
        profile.not_followed.emplace_back(rows.second);
    }
    return profile;
}

Profile measured_profile(const Context& context, const Scene& scene, const std::filesystem::path& shaders) {
    return with_written_codes(measured_profile(context, shaders), scene, shaders);
}

} // namespace lockstep
