#include "crosscheck/record/system_recorder.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/record/growing_file.hpp"
#include "crosscheck/record/layout.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "crosscheck/record/seal.hpp"
#include "crosscheck/record/state_extents.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/schema_json.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr hsize_t column_chunk = 1024;

} // namespace

/// The HDF5 file while it grows.
class SystemRecorder::File : public GrowingFile {
  public:
    File(const std::filesystem::path& temporary, std::string name, const System& system, const SystemRunInfo& info,
         int deflate)
        : GrowingFile(temporary, std::move(name), deflate) {
        write_head();
        write_run(system, info);
        for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r) {
            const Resource& resource = system.schema.resources[r];
            Columns& columns = resources_.emplace_back();
            for (const Field& field : resource.fields)
                columns.fields.push_back(make_rows(layout::state_value(resource, field), hdf5::file_type(field.scalar),
                                                   row_extents(resource, field, system.start.extent(r)), 1));
            columns.frame = make_rows(layout::state(resource) + "/frame", H5T_STD_I32LE, {}, column_chunk);
            columns.pass = make_rows(layout::state(resource) + "/pass", H5T_STD_I32LE, {}, column_chunk);
            add(r, -1, -1, system.start[r]);
        }
    }

    void add(std::uint8_t resource, std::int32_t frame, std::int32_t pass, const View& state) {
        Columns& columns = resources_[resource];
        for (std::size_t f = 0; f < columns.fields.size(); ++f)
            append(columns.fields[f], hdf5::memory_type(state.fields()[f].scalar), state.columns[f]);
        append(columns.frame, H5T_NATIVE_INT32, &frame);
        append(columns.pass, H5T_NATIVE_INT32, &pass);
    }

  private:
    /// Of a buffer or image.
    struct Columns {
        std::vector<Rows> fields;
        Rows frame, pass;
    };

    void write_run(const System& system, const SystemRunInfo& info) const {
        write_text(layout::system, system.schema.system);
        write_text(layout::schema, schema_json(system.schema).dump(1));
        write_text(layout::name, info.name);
        write_text(layout::frames, std::to_string(info.frames));
        if (!info.scene.is_null()) {
            write_text(layout::scene, info.scene.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
            write_text(layout::options, info.options.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
        }
        write_text(layout::renderer, info.renderer);
        write_text(layout::settings, info.settings);
        write_text(layout::shaders, info.shaders);
        write_text(layout::profile, profile_json(info.profile).dump(1));
        if (info.profile.roots) {
            const RootOffsets offsets = root_offsets(*info.profile.roots);
            write_array(layout::reciprocals, H5T_NATIVE_INT8, {offsets.reciprocal.size()}, offsets.reciprocal);
            write_array(layout::inverse_sqrts, H5T_NATIVE_INT8, {offsets.inverse_sqrt.size()}, offsets.inverse_sqrt);
        }
    }

    std::vector<Columns> resources_;
};

SystemRecorder::SystemRecorder(std::filesystem::path path, const System& system, const SystemRunInfo& info, int deflate)
    : system_(system), target_(std::move(path)) {
    const std::string name = fmt::format("{}: cannot be written", target_.path().string());
    if (target_.in_place())
        throw Error(fmt::format("{}: a recording is a regular file", name));
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r)
        if (system.start.extent(r).count() == 0)
            throw Error(fmt::format("{}: {} has no {}s", name, system.schema.resources[r].title,
                                    system.schema.resources[r].item));
    temporary_ = target_.make();
    file_ = std::make_unique<File>(temporary_, name, system, info, deflate);
}

SystemRecorder::~SystemRecorder() = default;

void SystemRecorder::add(std::size_t pass, int frame, const SystemState& state) {
    for (const std::uint8_t r : written_by(system_, pass))
        file_->add(r, frame, static_cast<std::int32_t>(pass), state[r]);
}

void SystemRecorder::commit() {
    file_->finish();
    file_.reset();
    seal_file(temporary_, system_.schema.system);
    target_.commit();
}

} // namespace lockstep
