#include <catch2/catch.hpp>

#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/collision/study/study_report.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/twin_scenes.hpp"

namespace lockstep::test::study_twin_test {

TEST_CASE("study twin: both sides give the same study, number for number") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* base : {"paper", "corrected", "exact"}) {
        Scene scene = test::crowded_scene(2000);
        scene.switches = preset(base);
        StudyOptions options;
        options.frames = 12;
        options.every = 3;
        const Profile profile = test::llvmpipe_profile();
        const auto reference = study_run(scene, profile, options);
        GpuSimulation gpu(scene, {});
        gpu.step(frame_params(scene, 0)); // a study starts at the scene's start, whatever ran before
        INFO(base);
        CHECK(reference.size() == 4);
        CHECK(total(reference).found_pairs > 0);
        CHECK(study_csv(study_run(scene, profile, gpu, options)) == study_csv(reference));
    }
}

} // namespace lockstep::test::study_twin_test
