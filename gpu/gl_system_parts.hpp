#pragma once
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "gpu/bound_storage.hpp"
#include "gpu/check.hpp"
#include "gpu/gl_system.hpp"
#include "gpu/gl_system_blocks.hpp"
#include "gpu/pass_timer.hpp"
#include "gpu/program.hpp"
#include "gpu/record_buffer.hpp"
#include "gpu/state_image.hpp"
#include "gpu/texture.hpp"
#include "gpu/vertex_capture.hpp"

namespace lockstep {

/// A framebuffer of one texel. A context without a surface has none, and then draws nothing: not even a point that
/// transform feedback alone would have.
class SmallestTarget {
  public:
    SmallestTarget() {
        allocate_texture(color_.id(), {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, 1, 1);
        bind();
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
        check_framebuffer(GL_FRAMEBUFFER, "framebuffer of one texel");
    }
    void bind() const { gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id()); }

  private:
    GlTexture color_;
    GlFramebuffer framebuffer_;
};

/// What GlSystem holds, and how it runs its passes: gl_system_draw.cpp draws and captures, gl_system_dispatch.cpp
/// dispatches.
struct GlSystem::Parts {
    struct Linked {
        GlPass pass;
        Program program;
        std::vector<BoundBlock> bound;                ///< of a compute pass
        BoundStorage by_member;                       ///< the rest of its blocks
        std::vector<std::uint8_t> resources;          ///< that it writes
        std::array<std::size_t, 3> group = {1, 1, 1}; ///< invocations along each axis
        std::size_t invocations = 1;                  ///< of a group
        std::vector<bool> ends_with_last = {};        ///< each of `bound`: the length() of its array is asked for
        std::optional<std::vector<VertexCapture>> traced = {};

        [[nodiscard]] bool may_write(const SystemStorage& storage) const {
            return !storage.block.empty() ||
                   std::find(resources.begin(), resources.end(), storage.layout.resource) != resources.end();
        }
        [[nodiscard]] bool binds(std::size_t storage) const {
            return std::any_of(bound.begin(), bound.end(), [&](const BoundBlock& block) {
                return block.kind != BoundBlock::Kind::data && block.storage == storage;
            });
        }
    };
    const Schema* schema;
    std::filesystem::path shaders;
    ArithmeticSwitch arithmetic;
    std::vector<SystemStorage> storages;
    std::vector<std::optional<Linked>> passes;      ///< none: its dispatch is that of the one before
    std::vector<std::vector<RecordBuffer>> buffers; ///< two a storage
    std::vector<std::size_t> current;               ///< of each buffer and image, which of the two the next pass reads
    std::map<std::uint8_t, std::vector<StateImage>> images = {}; ///< two a resource
    SmallestTarget target = {};                                  ///< of vertex passes
    GlQuery timer = {};
    std::optional<std::size_t> canary_laid = {}; ///< in what this pass will write: its next step keeps what it read
    std::optional<std::size_t> kept = {};        ///< the pass of the last step, where that is there to be repeated from
    std::array<GlSampler, 2> samplers = {};      ///< by GlFilter
    std::optional<std::uint64_t> ran_over = {};  ///< vertices or invocations of the last step
    bool takes_times = false;
    bool says_precise = true;       ///< each stage that computes, of something
    bool says_precise_once = false; ///< one of them does
    Seconds seconds = {};

    /// What the pass runs in a frame; null where there is nothing.
    [[nodiscard]] const Linked* running(std::size_t pass, int frame) const;
    void run(const Linked& linked, int frame);
    void step(std::size_t pass, int frame, bool keeps);
    /// Whether all of it is changed in place, without a copy of what was there where nothing is to be kept.
    [[nodiscard]] bool in_place(std::uint8_t resource) const {
        return !is_image(resource) && std::all_of(storages.begin(), storages.end(), [&](const SystemStorage& storage) {
            return storage.layout.resource != resource || !storage.block.empty();
        });
    }
    void capture(const Linked& linked);
    void draw(const Linked& linked);
    void dispatch_image(const Linked& linked);
    /// Binds the images that a compute pass writes, or reads by imageLoad.
    void bind_images(const Linked& linked);
    /// Lends the program the state's images, as the pass before left them.
    void lend_images(const Program& program, const GlPass& pass) const;
    [[nodiscard]] GLuint sampler(GlFilter filter) const;
    [[nodiscard]] bool is_image(std::uint8_t resource) const { return schema->resources[resource].dimensions > 1; }
    [[nodiscard]] StateImage& image_from(std::uint8_t resource) { return images.at(resource)[current[resource]]; }
    [[nodiscard]] StateImage& image_to(std::uint8_t resource) { return images.at(resource)[1 - current[resource]]; }
    /// Runs `work`, a draw or a dispatch, and takes its time.
    template <class Work> void timed(const Work& work);
    void dispatch(const Linked& linked, int frame);
    void check_ends(const Linked& linked, const std::string& when);
    /// Throws Error where a uniform or an attribute has no value.
    static void check_given(const Linked& linked);
    std::optional<GLintptr> group_counts(const Linked& linked);
    [[nodiscard]] std::vector<ShaderSource> sources(const GlPass& pass, std::span<const Stage> stages,
                                                    bool traced) const;
    /// What a program of the pass reads: an item a vertex, or an instance.
    [[nodiscard]] GlVertexArray inputs(const GlPass& pass, const Program& program);
    [[nodiscard]] std::size_t items(std::uint8_t resource) {
        return is_image(resource) ? image_from(resource).extent().count() : from(first_storage(resource)).size();
    }
    [[nodiscard]] ColorImage picture(const Linked& linked, int frame, const GlPicture& how);
    [[nodiscard]] std::size_t first_storage(std::uint8_t resource) const;
    [[nodiscard]] RecordBuffer& from(std::size_t storage) {
        return buffers[storage][current[storages[storage].layout.resource]];
    }
    [[nodiscard]] RecordBuffer& to(std::size_t storage) {
        return buffers[storage][1 - current[storages[storage].layout.resource]];
    }
};

template <class Work> void GlSystem::Parts::timed(const Work& work) {
    if (!takes_times)
        return work();
    gl::Finish();
    const auto start = std::chrono::steady_clock::now();
    {
        const RunningTimer timing(timer);
        work();
    }
    gl::Finish();
    seconds.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    seconds.timer = seconds_of(timer);
}

void set_uniforms(const Program& program, const GlPass& pass, std::size_t items, int frame);

} // namespace lockstep
