#pragma once
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reference/text/dispatch.hpp"
#include "tests/text/gl_programs.hpp"

namespace lockstep::test {

/// Runs the text of each compute shader that is dispatched, whichever host does it: what GL has bound before the
/// dispatch is read back, and what the text makes of it is held against what the dispatch left. While it lives, GL's
/// entry points go through it; one at a time.
class DispatchWatch {
  public:
    struct Row {
        std::size_t dispatches = 0, words = 0, changed = 0, differing = 0, findings = 0;
    };
    explicit DispatchWatch(Profile profile) : profile_(std::move(profile)) {
        instance() = this;
        real_dispatch_ = gl::DispatchCompute;
        gl::DispatchCompute = [](GLuint x, GLuint y, GLuint z) { instance()->dispatch({x, y, z}); };
    }
    ~DispatchWatch() {
        gl::DispatchCompute = real_dispatch_;
        instance() = nullptr;
    }
    DispatchWatch(const DispatchWatch&) = delete;
    DispatchWatch& operator=(const DispatchWatch&) = delete;

    /// By what the shader's first comment says.
    [[nodiscard]] const std::map<std::string, Row>& rows() const { return rows_; }

  private:
    static DispatchWatch*& instance() {
        static DispatchWatch* one = nullptr;
        return one;
    }

    void dispatch(std::array<std::uint32_t, 3> groups) {
        const GLuint id = GlPrograms::current_program();
        const std::string& text = programs_.current().at(GL_COMPUTE_SHADER);
        const text::Program& program = programs_.decoded(Stage::compute, text);
        BoundWords bound(id, program);
        const std::vector<Words> before = bound.blocks;
        real_dispatch_(groups[0], groups[1], groups[2]);
        gl::MemoryBarrier(GL_ALL_BARRIER_BITS);
        text::Findings findings;
        text::run_dispatch(program, {.groups = groups}, bound.bindings(), profile_, findings);
        Row& row = rows_[programs_.name_of(text)];
        ++row.dispatches;
        row.findings += findings.all().size();
        for (std::size_t b = 0; b < before.size(); ++b) {
            const Words after = BoundWords::block_words(id, program.blocks[b].name);
            row.words += after.size();
            for (std::size_t w = 0; w < after.size(); ++w) {
                row.changed += after[w] != before[b][w] ? 1 : 0;
                row.differing += after[w] != bound.blocks[b][w] ? 1 : 0;
            }
        }
    }

    Profile profile_;
    GlPrograms programs_;
    decltype(gl::DispatchCompute) real_dispatch_;
    std::map<std::string, Row> rows_;
};

} // namespace lockstep::test
