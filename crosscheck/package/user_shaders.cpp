#include <fmt/format.h>

#include "crosscheck/files/shell_words.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/simulation.hpp"
#include "lockstep/lockstep.hpp"

namespace lockstep {

UserShaders::UserShaders(const Gl& gl, const Scene& scene, const std::filesystem::path& folder, UnusedShaders unused)
    : gl_(gl), folder_(folder), unused_(unused) {
    if (!gl)
        throw Error(gl.missing());
    use_ = shader_use(scene, folder);
    check_shader_use(use_, folder, unused == UnusedShaders::allowed);
    const ShaderWarnings collected(warnings_);
    simulation_ = std::make_unique<GpuSimulation>(scene, folder);
}

UserShaders::~UserShaders() = default;

SideDescription UserShaders::describe() const {
    std::string arguments;
    if (gl_.asked() != "auto")
        arguments += fmt::format(" --gl {}", gl_.asked());
    if (!folder_.empty())
        arguments +=
            fmt::format(" --shaders {}", shell_word(std::filesystem::absolute(folder_).lexically_normal().string()));
    if (unused_ == UnusedShaders::allowed)
        arguments += " --allow-unused";
    return {gl_.name(), gl_.profile(folder_), arguments, use_, warnings_};
}

void UserShaders::upload(const Particles& particles, const CollisionImage& cdt) { simulation_->upload(particles, cdt); }
void UserShaders::step(const FrameParams& params) { simulation_->step(params); }
void UserShaders::begin_step(const FrameParams& params) { simulation_->begin_step(params); }
void UserShaders::read(Particles& particles) const { simulation_->read(particles); }
void UserShaders::read(CollisionImage& cdt) const { simulation_->read(cdt); }
bool UserShaders::repeats() const { return simulation_->repeats(); }
void UserShaders::lay_canary() { simulation_->lay_canary(); }
void UserShaders::find_canary(const Particles& particles, const CollisionImage& cdt, int frame) const {
    simulation_->find_canary(particles, cdt, frame);
}
void UserShaders::repeat_step(const FrameParams& params) { simulation_->repeat_step(params); }
bool UserShaders::holds(const Particles& particles) const { return simulation_->holds(particles); }

} // namespace lockstep
