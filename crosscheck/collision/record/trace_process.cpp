#include "crosscheck/collision/record/trace_process.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/record/messages.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "crosscheck/record/trace_file.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// The reading process's work.
class Reader {
  public:
    Reader(const OpenedFile& file, ReadingEnd& end)
        : end_(end), file_(file, collision_schema().resources[collision::particles]) {}

    void run() {
        end_.put_up_fence();
        file_.look_at_contents();
        warnings_ = file_.warnings();
        end_.allow(2 * (file_.particle_bytes() + file_.cdt_bytes()), warnings_);
        send_contents();
        Request request;
        while (end_.next(request))
            serve(request);
    }

  private:
    /// One state, read before it is asked for.
    struct Prepared {
        std::size_t index = SIZE_MAX;
        std::vector<std::byte> bytes;
    };

    void send_contents() {
        const auto positions = file_.obstacle_positions();
        const auto triangles = file_.obstacle_triangles();
        const auto reciprocals = file_.root_offsets(layout::reciprocals, reciprocal_count);
        const auto inverse_sqrts = file_.root_offsets(layout::inverse_sqrts, inverse_sqrt_count);
        const bool has_roots = !reciprocals.empty() && !inverse_sqrts.empty();
        nlohmann::json json{{"rows", file_.rows()},
                            {"particles", file_.particles()},
                            {"has_cdt", file_.has_cdt() ? 1 : 0},
                            {"has_velocity", file_.has_velocity() ? 1 : 0},
                            {"has_obstacles", triangles.empty() ? 0 : 1},
                            {"has_roots", has_roots ? 1 : 0},
                            {"scene", file_.text(layout::scene)},
                            {"name", file_.text(layout::name)},
                            {"profile", file_.text(layout::profile)},
                            {"renderer", file_.text(layout::renderer)},
                            {"settings", file_.text(layout::settings)},
                            {"shaders", file_.text(layout::shaders)},
                            {"probe", file_.text(layout::probe)},
                            {"program", file_.program()},
                            {"warnings", warnings_}};
        if (const std::vector<std::int32_t> counts = file_.counts(); !counts.empty())
            json["counts"] = counts;
        if (file_.has_cdt()) {
            json["cdt_height"] = file_.cdt_extents()[0];
            json["cdt_width"] = file_.cdt_extents()[1];
        }
        const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        end_.send(MessageKind::contents, text);
        if (!triangles.empty()) {
            end_.send(MessageKind::positions, positions);
            end_.send(MessageKind::triangles, triangles);
        }
        if (has_roots) {
            end_.send(MessageKind::reciprocals, reciprocals);
            end_.send(MessageKind::inverse_sqrts, inverse_sqrts);
        }
        serve({MessageKind::particles, 0});
    }

    void prepare(MessageKind kind, std::size_t index) {
        const bool cdt = kind == MessageKind::cdt;
        Prepared& prepared = cdt ? cdt_ : particles_;
        if (prepared.index == index)
            return;
        prepared.index = SIZE_MAX;
        prepared.bytes.resize(cdt ? file_.cdt_bytes() : file_.particle_bytes());
        if (cdt)
            file_.read_cdt(index, prepared.bytes.data());
        else
            file_.read_particles(index, prepared.bytes.data());
        prepared.index = index;
    }

    /// Answers, then reads ahead while the asking process works.
    void serve(const Request& request) {
        const bool cdt = request.kind == MessageKind::cdt;
        if (request.index >= file_.rows() - (cdt ? 1 : 0) || (cdt && !file_.has_cdt()))
            throw Error(fmt::format("row {} was asked for, there are {}", request.index, file_.rows()));
        prepare(request.kind, request.index);
        const std::vector<std::byte>& bytes = (cdt ? cdt_ : particles_).bytes;
        end_.send({request.kind, request.index, bytes.size()}, bytes.data());
        const std::size_t row = request.index + (cdt ? 2U : 1U);
        if (cdt != file_.has_cdt() && request.index != 0)
            return; // the CDT of this row is asked for next
        if (row < file_.rows()) {
            prepare(MessageKind::particles, row);
            if (file_.has_cdt())
                prepare(MessageKind::cdt, row - 1);
        }
    }

    ReadingEnd& end_;
    TraceFile file_;
    std::vector<std::string> warnings_;
    Prepared particles_, cdt_;
};

} // namespace

std::unique_ptr<ReadingProcess> start_trace_process(const OpenedFile& file) {
    return std::make_unique<ReadingProcess>(file, [&file](ReadingEnd& end) { Reader(file, end).run(); });
}

} // namespace lockstep
