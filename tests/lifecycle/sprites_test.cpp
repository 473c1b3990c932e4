#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/files/png.hpp"
#include "crosscheck/lifecycle/picture.hpp"
#include "crosscheck/lifecycle/scene.hpp"
#include "reference/model/lifecycle/drawing.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::sprites_test {

/// Sprites with a texture, as quads and as the polygon around what is to be seen, in the three ways of blending.
namespace lifecycle = lockstep::lifecycle;
using lifecycle::Emitter;
using lifecycle::Sprite;

namespace {

const std::string folder = "data/scenes/lifecycle/";

/// A second of a small scene with a texture.
struct Drawn {
    lifecycle::HostPtr host;
    SystemPicture picture;

    explicit Drawn(const lifecycle::Settings& settings) : host(host_of(settings)), picture(of(host)) {}

    [[nodiscard]] ColorImage on_reference() const {
        ReferenceRun run = reference_of(picture.system);
        run.step(0);
        return picture.image(run.state().view());
    }
    [[nodiscard]] ColorImage on_gl() const {
        GlSystemSide side(gl(), picture.system, picture.passes, "shaders/lifecycle", host->settings().arithmetic);
        side.upload(picture.system.start.view());
        return side.picture(0, 0, picture.how);
    }

  private:
    static SystemPicture of(const lifecycle::HostPtr& host) {
        const System system = lifecycle::system(host);
        ReferenceRun run = reference_of(system);
        for (int frame = 0; frame < 40; ++frame)
            run.step(frame);
        return lifecycle::picture(host, run.state(), 39);
    }
};

lifecycle::Settings leaves() {
    lifecycle::Settings s = lifecycle::load_scene(folder + "kgon_cuts.json", {.particles = 60});
    s.width = 320;
    s.height = 240;
    return s;
}

bool is_lit(const Drawn& drawn, const Rgba8& pixel) {
    const Rgba8& none = drawn.picture.how.background;
    return std::abs(int{pixel.r} - none.r) + std::abs(int{pixel.g} - none.g) + std::abs(int{pixel.b} - none.b) > 3;
}

std::size_t lit(const Drawn& drawn, const ColorImage& image) {
    return static_cast<std::size_t>(std::count_if(image.texels.begin(), image.texels.end(),
                                                  [&](const Rgba8& pixel) { return is_lit(drawn, pixel); }));
}

std::size_t lit(const lifecycle::Settings& settings) {
    const Drawn drawn(settings);
    return lit(drawn, drawn.on_reference());
}

} // namespace

TEST_CASE("sprites: the corners of polygons, and of segments beside them, agree with their twin") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = leaves();
    s.sprite.polygon = GENERATE(3, 6, 8);
    s.arithmetic = s.sprite.polygon == 6 ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    if (s.sprite.polygon != 8) {
        Emitter ribbon = s.emitters.front();
        ribbon.draw = Emitter::Draw::ribbon;
        s.emitters.push_back(ribbon);
    }
    const Drawn drawn(s);
    GlSystemSide side(gl(), drawn.picture.system, drawn.picture.passes, "shaders/lifecycle", s.arithmetic);
    CheckOptions options;
    options.frames = 1;
    const CheckReport report = check(drawn.picture.system, side, options);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
}

TEST_CASE("sprites: both sides' pictures are the same but for a few pixels, however they are blended") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = leaves();
    s.emitters.front().blend = GENERATE(Emitter::Blend::over, Emitter::Blend::additive, Emitter::Blend::opaque);
    s.sprite.filter =
        s.emitters.front().blend == Emitter::Blend::over ? Sprite::Filter::nearest : Sprite::Filter::bilinear;
    s.emitters.push_back(s.emitters.front());
    s.emitters.back().blend = Emitter::Blend::opaque;
    const Drawn drawn(s);
    const ColorImage reference = drawn.on_reference(), gpu = drawn.on_gl();
    const std::size_t shown = lit(drawn, gpu);
    std::size_t off = 0;
    for (std::size_t p = 0; p < gpu.texels.size(); ++p)
        off += std::abs(int{gpu.texels[p].g} - int{reference.texels[p].g}) > 3 ? 1 : 0;
    CHECK(shown > 3000);
    CHECK(off < shown / 50);
}

TEST_CASE("sprites: a polygon shows what the quad does; that of the texels' centres cuts (kgon_cuts)") {
    lifecycle::Settings s = leaves();
    const std::size_t polygon = lit(s);
    s.switches.hull_points = lifecycle::HullOf::centres;
    const std::size_t cut = lit(s);
    s.sprite.polygon = 0;
    const std::size_t quad = lit(s);
    CHECK(polygon == quad);
    CHECK(cut < quad - 20);
}

TEST_CASE("sprites: outside the texture nothing is shown, or its edge again (kgon_wraps)") {
    lifecycle::Settings s = lifecycle::load_scene(folder + "kgon_wraps.json", {.particles = 60});
    s.width = 320;
    s.height = 240;
    const std::size_t transparent = lit(s);
    s.switches.uv_outside = lifecycle::UvOutside::clamp;
    CHECK(lit(s) > transparent + transparent / 50);
    s.sprite.polygon = 0;
    const std::size_t quad = lit(s);
    CHECK(quad <= transparent);
    CHECK(quad > transparent * 49 / 50);
}

TEST_CASE("sprites: of opaque ones as near as each other the first is seen; of those that are added order is nothing") {
    const auto image_of = [](Emitter::Blend blend, bool green_first) {
        lifecycle::Settings s = leaves();
        Emitter red;
        red.capacity = 4;
        red.rate = 60.0;
        red.speed = 0.0F;
        red.size = {1.0F, 1.0F};
        red.blend = blend;
        red.min = {0.0F, 1.0F, 0.0F};
        red.color = {glm::vec4(0.25F, 0.0F, 0.0F, 1.0F), glm::vec4(0.25F, 0.0F, 0.0F, 1.0F)};
        Emitter green = red;
        green.color = {glm::vec4(0.0F, 0.25F, 0.0F, 1.0F), glm::vec4(0.0F, 0.25F, 0.0F, 1.0F)};
        s.emitters = green_first ? std::vector{green, red} : std::vector{red, green};
        return Drawn(s).on_reference();
    };
    const auto has = [](const ColorImage& image, const auto& looks) {
        return std::any_of(image.texels.begin(), image.texels.end(), looks);
    };
    const auto is_red = [](const Rgba8& pixel) { return pixel.g < 5 && pixel.b < 5; };
    const auto is_green = [](const Rgba8& pixel) { return pixel.r < 5 && pixel.b < 5; };
    const ColorImage red = image_of(Emitter::Blend::opaque, false), green = image_of(Emitter::Blend::opaque, true);
    CHECK((has(red, is_red) && !has(red, is_green)));
    CHECK((has(green, is_green) && !has(green, is_red)));
    CHECK(image_of(Emitter::Blend::additive, false).texels == image_of(Emitter::Blend::additive, true).texels);
    CHECK(image_of(Emitter::Blend::over, false).texels != image_of(Emitter::Blend::over, true).texels);
}

TEST_CASE("sprites: of a texture with nothing to be seen no corner is drawn") {
    lifecycle::Settings s = leaves();
    for (Rgba8& texel : s.sprite.texture.texels)
        texel.a = 0;
    CHECK(host_of(s)->sprite_corners().empty());
    CHECK(lit(s) == 0);
    s.sprite.alpha_cut = 254;
    CHECK(lit(s) == 0);
}

TEST_CASE("sprites: what is wrong with one is said in one line, with its place") {
    const TemporaryFolder files;
    const std::string image = png(ColorImage(8, 8, Rgba8{255, 255, 255, 255}));
    files.write("white.png", image);
    files.write("cut.png", image.substr(0, image.size() / 2));
    files.write("text.png", "no picture");
    files.write("empty.png", "");
    files.write("wide.png", png(ColorImage(8, 4, Rgba8{})));
    files.write("large.png", png(ColorImage(1025, 1025, Rgba8{})));
    const auto error_of = [&](const std::string& sprite, const std::string& emitter = "") -> std::string {
        const std::string text =
            R"({"system": "lifecycle", "sprite": {)" + sprite + R"(}, "emitters": [{)" + emitter + "}]}";
        const std::string name = (files.path() / "scene.json").string();
        try {
            const nlohmann::json document = parse_json(text, name);
            const lifecycle::Host host(lifecycle::read_scene(JsonValue(document, name)));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    CHECK(error_of(R"("texture": "white.png", "bounding": {"k": 4}, "filter": "bilinear")") == "");
    CHECK(error_of(R"("texture": "white.png", "bounding": "quad", "alpha_cut": 254)", R"("blend": "additive")") == "");
    const std::pair<const char*, const char*> wrong[] = {
        {R"("texture": "none.png")", "none.png: cannot be opened"},
        {R"("texture": "")", "/sprite/texture: names no file"},
        {R"("texture": "white\u0000.png")", "/sprite/texture: names no file"},
        {R"("texture": 3)", "/sprite/texture"},
        {R"("texture": "text.png")", "text.png: "},
        {R"("texture": "empty.png")", "empty.png: "},
        {R"("texture": "cut.png")", "cut.png: "},
        {R"("texture": "wide.png")", "/sprite/texture: is 8 x 4 texels; right is a square"},
        {R"("texture": "large.png")", "1025 x 1025 pixels; right is at most 1024"},
        {R"("bounding": {"k": 4})", "there is none"},
        {R"("texture": "white.png", "bounding": {"k": 2})", "/sprite/bounding/k"},
        {R"("texture": "white.png", "bounding": {"k": 9})", "/sprite/bounding/k"},
        {R"("texture": "white.png", "bounding": {"K": 4})", "K"},
        {R"("texture": "white.png", "bounding": "octagon")", "is neither \"quad\" nor {\"k\": 3 to 8}"},
        {R"("texture": "white.png", "bounding": 6)", "/sprite/bounding"},
        {R"("alpha_cut": 255)", "/sprite/alpha_cut"},
        {R"("alpha_cut": -1)", "/sprite/alpha_cut"},
        {R"("alpha_cut": 0.5)", "/sprite/alpha_cut"},
        {R"("filter": "linear")", "/sprite/filter"},
        {R"("image": "white.png")", "image"},
    };
    for (const auto& [sprite, words] : wrong) {
        const std::string error = error_of(sprite);
        INFO(sprite << "\n" << error);
        CHECK_THAT(error, Catch::Contains(words));
        CHECK(error.find('\n') == std::string::npos);
    }
    CHECK_THAT(error_of("", R"("blend": "alpha")"), Catch::Contains("/emitters/0/blend"));
}

} // namespace lockstep::test::sprites_test
