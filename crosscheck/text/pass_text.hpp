#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gpu/gl_system.hpp"
#include "reference/model/profile.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/text/dispatch.hpp"

namespace lockstep {

/// The words of a uniform's value.
std::vector<std::uint32_t> words_of(const UniformValue& value);

/// The shader of a compute pass as a text, with what GlSystem binds to it.
class PassText {
  public:
    /// `written`: the resources that the dispatch makes, of the pass and of those that continue it. Throws Error naming
    /// what is not interpreted, or what nothing is given for.
    PassText(const Schema& schema, GlPass pass, std::vector<std::uint8_t> written, const ShaderFolders& folders,
             ArithmeticSwitch arithmetic = ArithmeticSwitch::plain);

    [[nodiscard]] const text::Program& program() const { return program_; }
    [[nodiscard]] const GlPass& pass() const { return pass_; }
    [[nodiscard]] std::size_t items(const PassInput& in) const; ///< that its dispatch has invocations for

    /// What is run of a dispatch, as text::Dispatch has it.
    struct How {
        std::function<bool(const std::array<std::uint32_t, 3>& group)> wants = {};
        bool is_watched = false;
    };
    /// The dispatch in plain bits. `after`: a state as before it; what the dispatch writes of it is set.
    void run(const PassInput& in, const Profile& profile, SystemState& after, text::Findings& findings,
             const How& how) const;
    void run(const PassInput& in, const Profile& profile, SystemState& after, text::Findings& findings) const {
        run(in, profile, after, findings, {});
    }

  private:
    struct Bound {
        enum class Kind : std::uint8_t { before, after, data };
        Kind kind = Kind::data;
        std::uint8_t resource = 0;
        std::vector<Component> record = {}; ///< of a block: the words of an item
        std::string name = {};              ///< of data
    };
    [[nodiscard]] Bound block_named(const std::string& name) const;
    [[nodiscard]] Bound image_named(const std::string& name) const;
    [[nodiscard]] std::array<std::uint32_t, 3> groups(const PassInput& in) const;
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> uniforms(const PassInput& in) const;
    [[nodiscard]] bool writes(std::uint8_t resource) const;

    const Schema& schema_;
    GlPass pass_;
    std::vector<std::uint8_t> written_;
    std::shared_ptr<const ShaderSource> source_; ///< that lines are named by
    text::Program program_;
    std::vector<Bound> blocks_, images_;
};

} // namespace lockstep
