#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

#include "reference/dust/passes.hpp"
#include "reference/model/dust/schema.hpp"
#include "tests/dust/dust_run.hpp"

namespace lockstep::test {

/// Grains that a test places, and kernels of which the reference runs one after the other.
class Grains {
  public:
    explicit Grains(const dust::HostPtr& host)
        : passes_(dust::twins(host)), state(dust::schema(), {{host->settings().count}, {1}}) {
        state.set(dust::field::alive_number, 0, static_cast<std::uint32_t>(host->settings().count));
        for (std::size_t i = 0; i < host->settings().count; ++i)
            state.set(dust::field::alive, i, std::int32_t{1});
    }

    void place(std::size_t i, glm::vec3 position, glm::vec3 velocity) {
        state.set(dust::field::position, i, position);
        state.set(dust::field::velocity, i, velocity);
    }

    /// A kernel of a frame, by its name, and its count.
    void run(std::string_view kernel, int frame = 0) {
        const Profile strict = named_profile("strict");
        for (const auto& pass : passes_)
            if (pass->name() == kernel || pass->name() == std::string(kernel) + "_count") {
                const SystemState before = state;
                run_pass(*pass, {before.view(), frame}, strict, state[pass->resource()]);
            }
    }

    /// Grain 0 through a kernel that makes a mistake.
    void run_mistaken(std::string_view kernel, const Mistake& mistake, int frame) {
        for (const auto& pass : passes_)
            if (pass->name() == kernel) {
                const SystemState before = state;
                const auto words =
                    pass->mistaken({before.view(), frame}, 0, named_profile("strict"), std::span(&mistake, 1));
                const WritableView to = state[pass->resource()];
                std::size_t word = 0;
                for (std::size_t f = 0; f < to.fields().size(); ++f)
                    for (int c = 0; c < to.fields()[f].components; ++c)
                        state.set({pass->resource(), static_cast<std::uint8_t>(f)}, 0, words[word++], c);
            }
    }

    [[nodiscard]] glm::vec3 position(std::size_t i = 0) const { return state.view().vec3(dust::field::position, i); }
    [[nodiscard]] glm::vec3 velocity(std::size_t i = 0) const { return state.view().vec3(dust::field::velocity, i); }
    [[nodiscard]] glm::vec3 colour(std::size_t i = 0) const { return state.view().vec3(dust::field::colour, i); }
    [[nodiscard]] int alive(std::size_t i = 0) const { return state.view().integer(dust::field::alive, i); }
    [[nodiscard]] std::uint32_t count() const { return state.view().word(dust::field::alive_number, 0); }

  private:
    std::vector<std::unique_ptr<ItemPass>> passes_;

  public:
    SystemState state;
};

} // namespace lockstep::test
