#include "crosscheck/collision/record/trace_writer.hpp"

#include <utility>

#include <fmt/format.h>

#include "crosscheck/record/growing_file.hpp"
#include "crosscheck/record/layout.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "crosscheck/record/seal.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using hdf5::expect;
using hdf5::Extents;
using hdf5::Id;

constexpr hsize_t step_chunk = 1024;

} // namespace

/// The HDF5 file while it grows.
class TraceWriter::File : public GrowingFile {
  public:
    File(const std::filesystem::path& temporary, std::string name, const TraceInfo& info, int deflate);
    void add(const Particles& particles, const CollisionImage* cdt);

  private:
    void append_particles(const Particles& particles);
    void make_steps(const char* element, Rows& step, Rows& time) const;
    void write_box() const;
    void write_run(const TraceInfo& info) const;

    double tick_;
    std::vector<Rows> fields_;
    Rows step_, time_, cdt_, cdt_step_, cdt_time_;
};

TraceWriter::File::File(const std::filesystem::path& temporary, std::string name, const TraceInfo& info, int deflate)
    : GrowingFile(temporary, std::move(name), deflate), tick_(info.scene.constants.tick) {
    write_head();
    write_box();
    write_run(info);

    const hsize_t particles = info.scene.start.size();
    const View start = view(info.scene.start);
    const Resource& buffer = start.about();
    for (const Field& field : buffer.fields) {
        Extents extents{particles};
        if (field.components > 1)
            extents.push_back(static_cast<hsize_t>(field.components));
        fields_.push_back(make_rows(layout::value(buffer, field), hdf5::file_type(field.scalar), extents, 1));
    }
    const std::string first = layout::group(buffer, buffer.fields.front());
    make_steps(first.c_str(), step_, time_);
    for (const Field& field : buffer.fields)
        if (&field != &buffer.fields.front())
            for (const char* axis : {"step", "time"})
                expect(H5Lcreate_hard(file_.get(), fmt::format("{}/{}", first, axis).c_str(), file_.get(),
                                      fmt::format("{}/{}", layout::group(buffer, field), axis).c_str(), links_.get(),
                                      H5P_DEFAULT),
                       name_);
    if (info.has_cdt) {
        cdt_ = make_rows(layout::cdt, H5T_IEEE_F32LE,
                         {static_cast<hsize_t>(cdt_height(info.scene)), static_cast<hsize_t>(info.scene.width), 4}, 1);
        make_steps("observables/cdt", cdt_step_, cdt_time_);
    }
    append_particles(info.scene.start);
}

/// What H5MD asks of particles.
void TraceWriter::File::write_box() const {
    const Id box = make_group("particles/all/box");
    write_attribute(box.get(), "dimension", H5T_STD_I32LE, {3});
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose, name_);
    expect(H5Tset_size(type.get(), 4), name_);
    const hsize_t three = 3;
    const Id space(H5Screate_simple(1, &three, nullptr), H5Sclose, name_);
    const Id boundary(H5Acreate2(box.get(), "boundary", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                      name_);
    expect(H5Awrite(boundary.get(), type.get(), "nonenonenone"), name_);
}

void TraceWriter::File::write_run(const TraceInfo& info) const {
    write_text(layout::scene, settings_json(info.scene).dump(1));
    write_text(layout::name, info.scene.name);
    write_text(layout::renderer, info.renderer);
    write_text(layout::settings, info.settings);
    if (!info.shaders.empty())
        write_text(layout::shaders, info.shaders);
    if (!info.probe.empty())
        write_text(layout::probe, info.probe);
    if (info.profile)
        write_text(layout::profile, profile_json(*info.profile).dump(1));
    if (info.profile && info.profile->roots) {
        const RootOffsets offsets = root_offsets(*info.profile->roots);
        write_array(layout::reciprocals, H5T_NATIVE_INT8, {offsets.reciprocal.size()}, offsets.reciprocal);
        write_array(layout::inverse_sqrts, H5T_NATIVE_INT8, {offsets.inverse_sqrt.size()}, offsets.inverse_sqrt);
    }
    const Mesh& mesh = info.scene.obstacles;
    if (mesh.triangle_count() > 0) {
        write_array(layout::obstacle_positions, H5T_IEEE_F32LE, {mesh.positions.size(), 3}, mesh.positions);
        write_array(layout::obstacle_triangles, H5T_STD_U32LE, {mesh.triangle_count(), 3}, mesh.indices);
    }
}

void TraceWriter::File::make_steps(const char* element, Rows& step, Rows& time) const {
    step = make_rows(fmt::format("{}/step", element), H5T_STD_I32LE, {}, step_chunk);
    time = make_rows(fmt::format("{}/time", element), H5T_IEEE_F64LE, {}, step_chunk);
    write_attribute(time.set.get(), "unit", "s");
}

void TraceWriter::File::append_particles(const Particles& particles) {
    const std::int32_t step = static_cast<std::int32_t>(step_.count);
    const double time = step * tick_;
    const View state = view(particles);
    for (std::size_t f = 0; f < fields_.size(); ++f)
        append(fields_[f], hdf5::memory_type(state.fields()[f].scalar), state.columns[f]);
    append(step_, H5T_NATIVE_INT32, &step);
    append(time_, H5T_NATIVE_DOUBLE, &time);
}

void TraceWriter::File::add(const Particles& particles, const CollisionImage* cdt) {
    append_particles(particles);
    if (cdt == nullptr || cdt_.extents.empty())
        return;
    const std::int32_t step = static_cast<std::int32_t>(cdt_.count) + 1;
    const double time = step * tick_;
    append(cdt_, H5T_NATIVE_FLOAT, cdt->texels.data());
    append(cdt_step_, H5T_NATIVE_INT32, &step);
    append(cdt_time_, H5T_NATIVE_DOUBLE, &time);
}

TraceWriter::TraceWriter(std::filesystem::path path, const TraceInfo& info, int deflate) : target_(std::move(path)) {
    if (target_.in_place())
        throw Error(fmt::format("{}: cannot be written: a trace is a regular file", target_.path().string()));
    temporary_ = target_.make();
    file_ = std::make_unique<File>(temporary_, fmt::format("{}: cannot be written", target_.path().string()), info,
                                   deflate);
}

TraceWriter::~TraceWriter() = default;

void TraceWriter::add(const Particles& particles, const CollisionImage* cdt) { file_->add(particles, cdt); }

void TraceWriter::commit() {
    file_->finish();
    file_.reset();
    seal_file(temporary_);
    target_.commit();
}

} // namespace lockstep
