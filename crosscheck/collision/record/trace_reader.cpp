#include "crosscheck/collision/record/trace_reader.hpp"

#include "crosscheck/collision/record/trace_messages.hpp"
#include "crosscheck/collision/record/trace_process.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

TraceReader::TraceReader(const std::filesystem::path& file) : file_(file, "trace"), seal_(check_seal(file_)) {
    process_ = start_trace_process(file_);
    info_ = read_contents(*process_, process_->file(), file_.size());
    file_.expect_unchanged();
}

TraceReader::~TraceReader() = default;

void TraceReader::read(int frame, Particles& particles) {
    particles.resize(info_.scene.start.size());
    process_->ask(MessageKind::particles, frame + 1);
    read_particles(*process_, process_->file(), static_cast<std::uint32_t>(frame + 1), particles);
    file_.expect_unchanged();
}

void TraceReader::read(int frame, CollisionImage& cdt) {
    cdt.width = info_.scene.width;
    cdt.height = cdt_height(info_.scene);
    cdt.texels.resize(static_cast<std::size_t>(cdt.width) * static_cast<std::size_t>(cdt.height));
    process_->ask(MessageKind::cdt, frame);
    read_cdt(*process_, process_->file(), static_cast<std::uint32_t>(frame), cdt);
    file_.expect_unchanged();
}

} // namespace lockstep
