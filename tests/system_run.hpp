#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <lockstep/system.hpp>

namespace lockstep::test {

/// The one GL of a test program.
inline const Gl& gl() {
    static const Gl one;
    return one;
}

/// A run of a system on both sides.
inline CheckReport run_system(const System& system, std::vector<GlPass> passes, const std::string& shaders,
                              ArithmeticSwitch arithmetic, int frames, CheckMode mode) {
    GlSystemSide side(gl(), system, std::move(passes), shaders, arithmetic);
    CheckOptions options;
    options.frames = frames;
    options.mode = mode;
    return check(system, side, options);
}

/// llvmpipe's, but that these rows of the probe are not followed.
inline Profile not_following(std::vector<std::string> rows) {
    Profile profile = named_profile("llvmpipe");
    profile.not_followed = std::move(rows);
    return profile;
}

/// The shaders of this machine's GL, of whose driver `told` tells otherwise.
class OtherDriver final : public SystemSide {
  public:
    OtherDriver(const System& system, std::vector<GlPass> passes, const std::string& shaders,
                std::function<void(Profile&)> told)
        : side_(gl(), system, std::move(passes), shaders), told_(std::move(told)) {}

    [[nodiscard]] SideDescription describe() const override {
        SideDescription description = side_.describe();
        told_(description.profile);
        return description;
    }
    void upload(const SystemView& state) override { side_.upload(state); }
    void step(std::size_t pass, int frame) override { side_.step(pass, frame); }
    void read(SystemState& state) const override { side_.read(state); }

  private:
    GlSystemSide side_;
    std::function<void(Profile&)> told_;
};

} // namespace lockstep::test
