#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/page/report_page.hpp"
#include "crosscheck/files/base64.hpp"
#include "crosscheck/report/page/blob.hpp"
#include "gpu/collision/gpu_side.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::report_page_data_test {

namespace {

/// A GPU that is the reference, but for particles that are pushed away, and texels that are overwritten, in some
/// frames.
class FaultyGpu : public GpuSide {
  public:
    FaultyGpu(const Scene& scene, std::size_t pushed, int every)
        : simulation_(scene, named_profile("strict")), pushed_(pushed), every_(every) {}

    void upload(const Particles& particles, const CollisionImage& cdt) override {
        particles_ = particles;
        cdt_ = cdt;
        frame_ = 0;
    }
    void step(const FrameParams& params) override {
        simulation_.step_from(particles_, cdt_, params);
        particles_ = simulation_.particles();
        cdt_ = simulation_.cdt();
        if (++frame_ % every_ != 0)
            return;
        for (std::size_t i = 0; i < pushed_; ++i)
            particles_.position[i].x += 0.25F;
        for (std::size_t t = 0; t < std::min(pushed_, cdt_.texels.size()); ++t)
            cdt_.texels[t] = {9.0F, 9.0F, 9.0F, 1.0F};
    }
    void read(Particles& particles) const override { particles = particles_; }
    void read(CollisionImage& cdt) const override { cdt = cdt_; }

  private:
    ReferenceSimulation simulation_;
    Particles particles_;
    CollisionImage cdt_;
    std::size_t pushed_;
    int every_;
    int frame_ = 0;
};

Scene small_scene(std::size_t count, int side) {
    test::RandomScene random = test::random_scene(7, count, side, side);
    Scene scene;
    scene.name = "small";
    scene.start = random.particles;
    scene.width = side;
    scene.height = side;
    scene.constants = random.params.constants;
    scene.switches = random.params.switches;
    return scene;
}

struct Collected {
    CheckReport report;
    PageCollector page;
};

std::unique_ptr<Collected> collect(const Scene& scene, CheckMode mode, int frames, std::size_t pushed, int every = 3) {
    auto collected =
        std::make_unique<Collected>(Collected{{}, PageCollector(scene, named_profile("strict"), mode, frames)});
    FaultyGpu gpu(scene, pushed, every);
    FrameCheckOptions options;
    options.mode = mode;
    options.frames = frames;
    options.on_state = [&](const ComparedFrame& frame) { collected->page.add(frame); };
    collected->report = check(scene, named_profile("strict"), gpu, options);
    return collected;
}

std::size_t bytes(const KeptFrame& frame) { return frame.picture.size() + frame.detail.size() + frame.whole.size(); }

std::size_t bytes(const std::vector<KeptFrame>& frames) {
    std::size_t sum = 0;
    for (const KeptFrame& frame : frames)
        sum += bytes(frame);
    return sum;
}

bool has(const std::vector<KeptFrame>& frames, int wanted) {
    return std::any_of(frames.begin(), frames.end(), [&](const KeptFrame& frame) { return frame.frame == wanted; });
}

} // namespace

TEST_CASE("report page data: base64 as RFC 4648 has it") {
    CHECK(base64("").empty());
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("report page data: what is deflated comes back") {
    const std::string text = std::string(100'000, 'x') + "lockstep" + std::string(3, '\0');
    const std::string packed = deflated(text);
    CHECK(packed.size() < 1000);
    std::string back(text.size(), '?');
    uLongf length = back.size();
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(back.data()), &length, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()) == Z_OK);
    CHECK(back == text);
}

TEST_CASE("report page data: words lie byte by byte, bits from the lowest") {
    Blob blob;
    blob.words(std::vector<std::uint32_t>{0x04030201, 0x14131211});
    blob.word(0x24232221);
    blob.bits(10, [](int i) { return i == 0 || i == 9; });
    CHECK(blob.str() == std::string("\x01\x11\x02\x12\x03\x13\x04\x14\x21\x22\x23\x24\x01\x02"));
}

TEST_CASE("report page data: a resync run has the free run's numbers beside its own, and a free run the resync one's") {
    const Scene scene = small_scene(200, 24);
    const auto resync = collect(scene, CheckMode::resync, 12, 5);
    const auto free = collect(scene, CheckMode::free, 12, 5);
    REQUIRE(resync->report.first_frame == 2);
    nlohmann::json a = resync->page.series().json();
    nlohmann::json b = free->page.series().json();
    CHECK(a.at("resync") == b.at("resync"));
    CHECK(a.at("free") == b.at("free"));
    CHECK(a.at("resync") != a.at("free"));
    CHECK(a.at("resync").at("particles") == nlohmann::json{0, 0, 5, 0, 0, 5, 0, 0, 5, 0, 0, 5});
    CHECK(a.at("free").at("particles").at(4) >= 5);
    CHECK(a.at("classes").at("particles").at(2) == nlohmann::json{0, 0, 0, 5});
    for (const FrameCount& count : free->report.counts) {
        const auto f = static_cast<std::size_t>(count.frame);
        CHECK(b.at("free").at("particles").at(f) == count.items[collision::particles]);
        CHECK(b.at("free").at("texels").at(f) == count.items[collision::cdt]);
        CHECK(b.at("free").at("ulp").at(f) == count.worst_ulp);
    }
}

TEST_CASE("report page data: a long run shares points, which keep the largest number") {
    const Scene scene = small_scene(2, 4);
    DifferenceSeries series(scene, named_profile("strict"), CheckMode::free);
    const Particles& particles = scene.start;
    const CollisionImage cdt = empty_cdt(scene);
    const int frames = 3 * static_cast<int>(DifferenceSeries::most_points);
    for (int frame = 0; frame < frames; ++frame) {
        Comparison comparison;
        comparison.resources = {{.differing = frame == 5001 ? 2U : 0U}};
        if (frame == 5001)
            comparison.worst.push_back({collision::speed, 0, 0, 0.0F, 0.0F, std::numeric_limits<std::int64_t>::max()});
        series.add({frame, particles, cdt, particles, cdt, comparison}, particles, cdt, frame_params(scene, frame));
    }
    const nlohmann::json json = series.json();
    CHECK(json.at("stride") == 4);
    CHECK(json.at("frame").size() == 3072);
    CHECK(json.at("frame").at(1250) == 5000);
    CHECK(json.at("free").at("particles").at(1250) == 2);
    CHECK(json.at("free").at("ulp").at(1250).is_null());
    CHECK(json.at("free").at("particles").at(1251) == 0);
}

TEST_CASE("report page data: with little room, the first frame that differs stays, then the last") {
    const Scene scene = small_scene(200, 24);
    const auto run = collect(scene, CheckMode::resync, 30, 3, 8);
    const FrameKeeper& frames = run->page.frames();
    const std::vector<KeptFrame> all = frames.within(100'000'000);
    CHECK(all.size() == 30);
    const KeptFrame first = all.at(7);
    CHECK(first.frame == 7);
    CHECK(first.differs);
    CHECK(frames.within(0).empty());
    CHECK(has(frames.within(bytes(first)), 7));
    CHECK(frames.within(bytes(first)).size() == 1);
    const auto two = frames.within(bytes(first) + bytes(all.back()));
    CHECK(has(two, 7));
    CHECK(has(two, 29));
    for (const std::size_t room : {5'000U, 20'000U, 50'000U}) {
        const auto kept = frames.within(room);
        CHECK(bytes(kept) <= room);
        CHECK(std::is_sorted(kept.begin(), kept.end(),
                             [](const KeptFrame& a, const KeptFrame& b) { return a.frame < b.frame; }));
    }
}

TEST_CASE("report page data: items are the first of each class, particles and texels") {
    const Scene scene = small_scene(400, 24);
    const auto run = collect(scene, CheckMode::resync, 6, 100);
    std::size_t particles = 0;
    std::size_t texels = 0;
    for (const PageItem& item : run->page.frames().items()) {
        if (item.kind == class_same)
            continue;
        CHECK(item.kind == static_cast<std::uint8_t>(DifferenceClass::divergent));
        CHECK(item.frame == 2);
        (item.texel ? texels : particles) += 1;
    }
    CHECK(particles == FrameKeeper::items_of_a_class);
    CHECK(texels == FrameKeeper::items_of_a_class);
}

TEST_CASE("report page data: a page of frames that all differ stays within 5 MB") {
    const Scene scene = small_scene(30'000, 256);
    const auto run = collect(scene, CheckMode::free, 20, 30'000, 1);
    const std::string page = report_page("<!-- lockstep data -->", run->page, run->report,
                                         RunDescription{"small", "", "", "", "resync", "", ""}, {}, {}, {});
    CHECK(page.size() <= largest_page);
    CHECK(page.size() > largest_page / 2);
}

TEST_CASE("report page data: a scene too large for the live view leaves it out, and the page within 5 MB") {
    Scene scene = small_scene(50, 16);
    test::Random random(5);
    for (int i = 0; i < 300'000; ++i)
        scene.obstacles.positions.emplace_back(random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F), 9.0F);
    const auto run = collect(scene, CheckMode::resync, 2, 0);
    const std::string page = report_page("<!-- lockstep data -->", run->page, run->report,
                                         RunDescription{"small", "", "", "", "resync", "", ""}, {}, {}, {});
    CHECK(page.size() < 100'000);
}

} // namespace lockstep::test::report_page_data_test
