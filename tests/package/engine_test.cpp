#include <catch2/catch.hpp>

#include <lockstep/lockstep.hpp>

#include "tests/package/reference_engine.hpp"

namespace lockstep::test::engine_test {

using Catch::Contains;
using test::ReferenceEngine;

namespace {

Scene streams() { return load_scene(shipped_scene("x_streams"), {.particles = 300}); }

/// Gives back a CDT that `spoil` changed.
class SpoiltCdt : public ReferenceEngine {
  public:
    SpoiltCdt(const Scene& scene, void (*spoil)(CollisionImage&)) : ReferenceEngine(scene), spoil_(spoil) {}
    using ReferenceEngine::read;
    void read(CollisionImage& cdt) const override {
        ReferenceEngine::read(cdt);
        spoil_(cdt);
    }

  private:
    void (*spoil_)(CollisionImage&);
};

/// Runs a frame again with another answer, or says that it can and cannot.
class Repeating : public ReferenceEngine {
  public:
    enum class Again { another_answer, same_answer, left_out };
    Repeating(const Scene& scene, Again again, Fault fault = {})
        : ReferenceEngine(scene, std::move(fault)), again_(again) {}
    [[nodiscard]] bool repeats() const override { return true; }
    void repeat_step(const FrameParams& params) override {
        if (again_ == Again::left_out)
            GpuSide::repeat_step(params);
        if (again_ == Again::another_answer)
            change([](Particles& particles) { particles.speed[7] += 1.0F; });
    }

  private:
    Again again_;
};

/// Has no CDT, and says so; being asked for one all the same is the failure.
class NoCdt : public Repeating {
  public:
    explicit NoCdt(const Scene& scene, Fault fault = {}) : Repeating(scene, Again::same_answer, std::move(fault)) {}
    using Repeating::read;
    [[nodiscard]] bool has_cdt() const override { return false; }
    void read(CollisionImage& /*cdt*/) const override { FAIL("asked for a CDT that there is none of"); }
};

std::string error_of(GpuSide& engine, const Scene& scene) {
    try {
        return "passed: " + match_reference(engine, scene, {.frames = 4}).text();
    } catch (const Error& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("engine: a state of another size is an error that names the field and both sizes") {
    const Scene scene = streams();
    const auto error_after = [&](ReferenceEngine::Fault fault) {
        ReferenceEngine engine(scene, std::move(fault));
        return error_of(engine, scene);
    };
    const auto in_frame_2 = [](auto change) {
        return [change](int frame, Particles& particles) {
            if (frame == 2)
                change(particles);
        };
    };
    CHECK(error_after(in_frame_2([](Particles& p) { p.resize(299); })) ==
          "an engine of its own: gives back position of 299 particles; the scene has 300");
    CHECK(error_after(in_frame_2([](Particles& p) { p.resize(301); })) ==
          "an engine of its own: gives back position of 301 particles; the scene has 300");
    CHECK(error_after(in_frame_2([](Particles& p) { p.resize(0); })) ==
          "an engine of its own: gives back position of 0 particles; the scene has 300");
    CHECK(error_after(in_frame_2([](Particles& p) { p.direction.pop_back(); })) ==
          "an engine of its own: gives back direction of 299 particles; the scene has 300");
    CHECK(error_after(in_frame_2([](Particles& p) { p.speed.clear(); })) ==
          "an engine of its own: gives back speed of 0 particles; the scene has 300");
    CHECK(error_after(in_frame_2([](Particles& p) { p.collide_time.push_back(0.0F); })) ==
          "an engine of its own: gives back collide_time of 301 particles; the scene has 300");
}

TEST_CASE("engine: a CDT of another size is an error") {
    const Scene scene = streams();
    for (void (*const spoil)(CollisionImage&) :
         {+[](CollisionImage& cdt) { cdt = CollisionImage(cdt.width, cdt.height - 1); },
          +[](CollisionImage& cdt) { cdt = CollisionImage(cdt.height * 2, cdt.width / 2); },
          +[](CollisionImage& cdt) { cdt.texels.pop_back(); }, +[](CollisionImage& cdt) { cdt = {}; }}) {
        SpoiltCdt engine(scene, spoil);
        CHECK_THAT(error_of(engine, scene), Contains("an engine of its own: gives back a CDT of ") &&
                                                Contains("texels; the scene's has 500 x 500, 250000 texels"));
    }
}

TEST_CASE("engine: a start whose fields are of several sizes is an error") {
    Scene scene = streams();
    ReferenceEngine engine(scene);
    scene.start.speed.pop_back();
    CHECK(error_of(engine, scene) == "x_streams: its start has speed of 299 particles; the scene has 300");
}

TEST_CASE("engine: one that repeats is held to it, without any more of it than repeat_step") {
    const Scene scene = streams();
    Repeating other(scene, Repeating::Again::another_answer);
    CHECK(match_reference(other, scene, {.frames = 4}).report().verdict == Verdict::nondeterministic);
    Repeating same(scene, Repeating::Again::same_answer);
    CHECK(match_reference(same, scene, {.frames = 4}).passed());
    Repeating none(scene, Repeating::Again::left_out);
    CHECK(error_of(none, scene) == "an engine of its own: says that it repeats a frame, but has no repeat_step");
}

TEST_CASE("engine: without a CDT it is never asked for one, and its particles are judged") {
    const Scene scene = streams();
    NoCdt engine(scene);
    const MatchResult result = match_reference(engine, scene, {.frames = 4});
    CHECK(result.passed());
    CHECK(result.report().total[collision::texel].compared == 0);
    NoCdt wrong(scene, [](int frame, Particles& particles) { particles.speed[7] += frame == 2 ? 1.0F : 0.0F; });
    CHECK_FALSE(match_reference(wrong, scene, {.frames = 4}).passed());
}

} // namespace lockstep::test::engine_test
