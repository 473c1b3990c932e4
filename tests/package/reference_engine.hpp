#pragma once
#include <functional>
#include <string>
#include <utility>

#include "gpu/collision/gpu_side.hpp"
#include "reference/collision/simulation.hpp"

namespace lockstep::test {

/// An engine that computes what the reference computes, on the same scene, until `fault` changes what is read of a
/// frame. Needs no GL.
class ReferenceEngine : public GpuSide {
  public:
    using Fault = std::function<void(int frame, Particles& particles)>;

    explicit ReferenceEngine(const Scene& scene, Fault fault = {})
        : simulation_(scene, Profile{}), fault_(std::move(fault)) {}

    void upload(const Particles& particles, const CollisionImage& cdt) override {
        particles_ = particles;
        cdt_ = cdt;
    }
    void step(const FrameParams& params) override {
        simulation_.step_from(particles_, cdt_, params);
        upload(simulation_.particles(), simulation_.cdt());
        if (fault_)
            fault_(frame_, particles_);
        ++frame_;
    }
    /// Changes the state it has now.
    void change(const std::function<void(Particles&)>& change) { change(particles_); }

    void read(Particles& particles) const override { particles = particles_; }
    void read(CollisionImage& cdt) const override { cdt = cdt_; }

  private:
    ReferenceSimulation simulation_;
    Fault fault_;
    Particles particles_;
    CollisionImage cdt_;
    int frame_ = 0;
};

} // namespace lockstep::test
