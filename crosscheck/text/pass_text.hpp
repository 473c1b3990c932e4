#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/gl_system.hpp"
#include "reference/model/profile.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/text/dispatch.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/outcomes.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {

/// The words of a uniform's value.
std::vector<std::uint32_t> words_of(const UniformValue& value);

/// Of what a host gives, the words of one uniform, of an array those of its elements; none: nothing is given.
std::vector<std::uint32_t> words_given(const Uniforms& given, const text::PlainUniform& uniform);

/// The shader of a compute pass, of a vertex pass that is captured, or of a draw over the full screen, as a text, with
/// what GlSystem binds to it.
class PassText {
  public:
    /// `written`: the resources that the dispatch makes, of the pass and of those that continue it. Throws Error naming
    /// what is not interpreted, or what nothing is given for.
    PassText(const Schema& schema, GlPass pass, std::vector<std::uint8_t> written, const ShaderFolders& folders,
             ArithmeticSwitch arithmetic = ArithmeticSwitch::plain);

    [[nodiscard]] const text::Program& program() const { return program_; }
    [[nodiscard]] const text::Outcomes& outcomes() const { return outcomes_; }
    [[nodiscard]] const GlPass& pass() const { return pass_; }
    /// Whether the pass's shader of these folders is this text.
    [[nodiscard]] bool is_text_of(const ShaderFolders& folders) const;
    [[nodiscard]] const ShaderSource& source() const { return *source_; }
    PassText(const PassText&) = delete;
    PassText& operator=(const PassText&) = delete;
    [[nodiscard]] std::size_t items(const PassInput& in) const; ///< that its dispatch has invocations for
    /// Each item has an invocation of its own: a vertex, or a fragment.
    [[nodiscard]] bool is_per_item() const { return pass_.stage != Stage::compute; }
    /// Then which one it is, in an image of this extent. Fragments are numbered quad by quad.
    [[nodiscard]] std::uint32_t invocation_of(std::size_t item, const Extent& extent) const;

    /// What is run of a dispatch, as text::Dispatch has it. Vertices that are watched, or whose coverage is asked for,
    /// count as groups of lanes_at_once, and make no words.
    struct How {
        std::function<bool(const std::array<std::uint32_t, 3>& group)> wants = {};
        bool is_watched = false;
        text::Coverage* coverage = nullptr;
    };
    /// The dispatch in plain bits. `after`: a state as before it; what the dispatch writes of it is set.
    void run(const PassInput& in, const Profile& profile, SystemState& after, text::Findings& findings,
             const How& how) const;
    void run(const PassInput& in, const Profile& profile, SystemState& after, text::Findings& findings) const {
        run(in, profile, after, findings, {});
    }

    /// What its dispatch is bound to in one input: words of blocks, then of images, then of what a vertex pass makes.
    struct Input {
        std::vector<std::vector<std::uint32_t>> words;
        text::Bindings bindings; ///< refers to them
        std::array<std::uint32_t, 3> groups{1, 1, 1};
        text::StageRun stage; ///< of vertices or fragments
        Extent extent;        ///< of the items that these make
    };
    /// Throws Error where the driver filters as the text's reading does not.
    [[nodiscard]] Input bind(const PassInput& in, const Profile& profile) const;
    /// Where the words of a resource that is written lie in Input::words: a block for each part of its items, or an
    /// image.
    [[nodiscard]] std::vector<std::size_t> words_of_resource(std::uint8_t resource) const;
    /// The components of an item in those words, in their order; no_component where a word is none.
    [[nodiscard]] std::span<const Component> record(std::size_t words) const;
    /// Which of the components of an item of a vertex pass an output's cell is.
    [[nodiscard]] std::optional<std::size_t> captured_component(std::uint64_t cell) const;
    /// Whether it reads what the resource was before.
    [[nodiscard]] bool reads(std::uint8_t resource) const;
    /// Where an invocation is, by its number.
    [[nodiscard]] text::Invocation invocation(const Input& input, std::uint32_t number) const {
        return is_per_item() ? text::Invocation{.number = number} : text::invocation_of(program_, input.groups, number);
    }
    /// The inputs of one vertex or fragment.
    [[nodiscard]] std::vector<text::GivenInput> inputs_of(const Input& input, std::uint32_t vertex) const;
    /// Runs the whole into the words: of `to`, which has as many as input.words.
    void run_into(const Input& input, const Profile& profile, text::Findings& findings, const How& how,
                  text::Writers* writers, std::vector<std::vector<std::uint32_t>>& to) const;

  private:
    struct Bound {
        enum class Kind : std::uint8_t { before, after, data, uniforms };
        Kind kind = Kind::data;
        std::uint8_t resource = 0;
        std::vector<Component> record = {}; ///< of a block: the words of an item; a word between fields is no_component
        std::string name = {};              ///< of data
        std::size_t number = 0;             ///< of uniforms: the block's
    };
    [[nodiscard]] Bound block_named(const std::string& name) const;
    [[nodiscard]] Bound image_named(const std::string& name) const;
    [[nodiscard]] const Bound& bound(std::size_t words) const {
        return words < blocks_.size()                    ? blocks_[words]
               : words < blocks_.size() + images_.size() ? images_[words - blocks_.size()]
                                                         : *captured_;
    }
    [[nodiscard]] std::size_t bound_words() const { return blocks_.size() + images_.size() + (captured_ ? 1 : 0); }
    void capture();
    void capture_output();
    [[nodiscard]] text::StageRun vertices(const PassInput& in) const;
    [[nodiscard]] text::StageRun fragments(const PassInput& in) const;
    [[nodiscard]] std::array<std::uint32_t, 3> groups(const PassInput& in) const;
    [[nodiscard]] Uniforms given(const PassInput& in) const;
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> uniforms(const PassInput& in) const;
    [[nodiscard]] bool writes(std::uint8_t resource) const;
    [[noreturn]] void refuse(std::string_view what) const;

    const Schema& schema_;
    GlPass pass_;
    std::vector<std::uint8_t> written_;
    ArithmeticSwitch arithmetic_;
    std::shared_ptr<const ShaderSource> source_; ///< that lines are named by
    text::Program program_;
    text::Outcomes outcomes_{program_};
    std::vector<Bound> blocks_, images_;
    std::optional<Bound> captured_; ///< of vertices or fragments
    /// A component of it: that of an output.
    struct CapturedCell {
        std::string output;
        std::uint32_t cells = 0, component = 0; ///< of the output
        std::uint32_t cell = 0;
    };
    std::vector<CapturedCell> captured_cells_;
};

} // namespace lockstep
