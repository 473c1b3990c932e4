#pragma once
#include <cstring>
#include <functional>
#include <utility>

#include "crosscheck/judge/system.hpp"
#include "gpu/system_side.hpp"

namespace lockstep::test {

/// A GPU that runs the twins in the arithmetic of a driver of its own, but for what is planted after a pass.
class TwinSide : public SystemSide {
  public:
    using Plant = std::function<void(std::size_t pass, int frame, SystemState& state)>;

    /// `system` outlives this. `runs`: how this driver rounds; `described`: what is said of it.
    TwinSide(const System& system, Profile runs, Profile described, Plant plant = {})
        : system_(system), runs_(std::move(runs)), described_(std::move(described)), plant_(std::move(plant)),
          state_(system.start), next_(system.start) {}

    [[nodiscard]] SideDescription describe() const override { return {"twins", described_, {}, {}}; }
    void upload(const SystemView& state) override {
        for (std::uint8_t r = 0; r < system_.schema.resources.size(); ++r) {
            const WritableView into = state_[r];
            for (std::size_t f = 0; f < into.columns.size(); ++f)
                std::memcpy(into.columns[f], state[r].columns[f],
                            into.count() * static_cast<std::size_t>(into.fields()[f].components) * sizeof(float));
        }
    }
    void step(std::size_t pass, int frame) override {
        do {
            run_pass(*system_.passes[pass], state_, frame, runs_, next_);
            state_.swap(system_.passes[pass]->resource(), next_);
            if (plant_)
                plant_(pass, frame, state_);
        } while (++pass < system_.passes.size() && system_.passes[pass]->continues());
    }
    void read(SystemState& state) const override { state = state_; }

  private:
    const System& system_;
    Profile runs_, described_;
    Plant plant_;
    SystemState state_, next_;
};

} // namespace lockstep::test
