#include "crosscheck/collision/report/frame_images.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "crosscheck/collision/judge/render_judge.hpp"
#include "crosscheck/collision/report/pictures.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/report/picture_difference.hpp"
#include "gpu/collision/render_pass.hpp"
#include "reference/collision/render_pass.hpp"

namespace lockstep {

ColorImage render_on_gpu(const Particles& particles, const Scene& scene, const FrameParams& params,
                         const std::filesystem::path& shaders) {
    RenderPass pass(scene.switches, shaders, params.render_width, params.render_height);
    ParticleBuffer buffer(particles.size());
    buffer.upload(particles);
    pass.run(buffer, MeshBuffer(scene.obstacles), params);
    ColorImage image;
    pass.read(image);
    return image;
}

RenderVerdict judge_rendered(const Particles& particles, const Particles* earlier, const Scene& scene, int frame,
                             const Profile& profile, const KnownOperations& known,
                             const std::filesystem::path& shaders) {
    const FrameParams params = frame_params(scene, frame);
    const FrameParams earlier_params = frame_params(scene, std::max(frame - 1, 0));
    const ColorImage gpu = render_on_gpu(particles, scene, params, shaders);
    RenderVerdict verdict =
        judge_render({particles, scene.obstacles, params, earlier, &earlier_params}, profile, known, gpu);
    verdict.frame = frame;
    return verdict;
}

JudgedPicture judged_picture(const FrameRun& run, const std::filesystem::path& shaders) {
    const JudgedFrame frame = run.judged();
    return {run, render_on_gpu(frame.gpu, run.scene(), frame.params, shaders)};
}

void FrameImages::keep(const ComparedFrame& frame) {
    if (differs_)
        return;
    frame_ = frame.frame;
    differs_ = !frame.comparison.agree();
    reference_ = frame.reference;
    gpu_ = frame.gpu;
    reference_cdt_ = frame.reference_cdt;
    gpu_cdt_ = frame.gpu_cdt;
}

std::array<std::string, 3> FrameImages::rendered(const Scene& scene, const Profile& profile,
                                                 const std::filesystem::path& shaders) const {
    const FrameParams params = frame_params(scene, frame_);
    const ColorImage reference = render_pass(reference_, scene.obstacles, params, profile);
    const ColorImage gpu = render_on_gpu(gpu_, scene, params, shaders);
    return {png(reference), png(gpu), png(difference_picture(reference, gpu))};
}

void FrameImages::write(OutputFiles& files, const std::filesystem::path& directory, const Scene& scene,
                        const Profile& profile, const std::filesystem::path& shaders) const {
    if (frame_ < 0)
        return;
    const Box box = code_box(reference_cdt_);
    const ColorImage cdts[]{picture(reference_cdt_, box), picture(gpu_cdt_, box),
                            difference_picture(reference_cdt_, gpu_cdt_)};
    std::array<std::string, 3> frames = rendered(scene, profile, shaders);
    static_assert(std::size(cdts) + std::tuple_size_v<decltype(frames)> == names.size());
    for (std::size_t i = 0; i < std::size(cdts); ++i) {
        files.write(directory / names[i], png(cdts[i]));
        files.write(directory / names[i + std::size(cdts)], std::move(frames[i]));
    }
}

} // namespace lockstep
