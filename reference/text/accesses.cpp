#include "reference/text/accesses.hpp"

#include <cstdint>
#include <map>

namespace lockstep::text {
namespace {

void add(Access& access, bool reads, bool writes) {
    access.is_read = access.is_read || reads;
    access.is_written = access.is_written || writes;
}

class Reader {
  public:
    explicit Reader(const Program& program) : program_(program) {
        made_.blocks.resize(program.blocks.size());
        made_.images.resize(program.images.size());
        for (const CellWord& constant : program.constants)
            if (!constant.is_real && constant.word < program.images.size())
                image_in_.emplace(constant.cell, constant.word);
    }

    Accesses read() {
        for (const Step& step : program_.steps)
            read(step);
        return std::move(made_);
    }

  private:
    void read(const Step& step) {
        switch (step.op) {
        case code::copy:
            for (std::uint32_t c = 0; c < step.n; ++c)
                if (const auto found = image_in_.find(step.a + c); found != image_in_.end())
                    image_in_.emplace(step.out + c, found->second);
            return;
        case code::load_block:
            return add(made_.blocks[step.a], true, false);
        case code::store_block:
            return add(made_.blocks[step.a], false, true);
        case code::atomic_block:
            return add(made_.blocks[step.a], true, true);
        case code::load_texel:
        case code::fetch_texel:
        case code::sample_texel:
            return add_image(step.a, true, false);
        case code::store_texel:
            return add_image(step.a, false, true);
        case code::atomic_texel:
            return add_image(step.a, true, true);
        default:
            return;
        }
    }

    void add_image(std::uint32_t cell, bool reads, bool writes) {
        if (const auto found = image_in_.find(cell); found != image_in_.end())
            return add(made_.images[found->second], reads, writes);
        for (Access& one : made_.images)
            add(one, reads, writes);
    }

    const Program& program_;
    Accesses made_;
    std::map<std::uint32_t, std::uint32_t> image_in_; ///< by the cell that holds its number
};

} // namespace

Accesses accesses_of(const Program& program) { return Reader(program).read(); }

} // namespace lockstep::text
