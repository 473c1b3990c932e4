#include "crosscheck/collision/record/trace_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/record/hdf5.hpp"
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

constexpr hsize_t largest_chunk = hsize_t{4} << 20U; // bytes
constexpr hsize_t step_chunk = 1024;
constexpr std::size_t first_blocks = 4096; // bytes, of what HDF5 writes when it creates a file

/// Whether there is room for a file's first blocks. HDF5 2 ends the program where there is none.
void check_room(const std::filesystem::path& file, const std::string& name) {
    std::ofstream stream(file, std::ios::binary);
    errno = 0;
    if (!stream.write(std::string(first_blocks, '\0').data(), first_blocks).flush())
        throw Error(fmt::format("{}: {}", name, std::strerror(errno)));
}

} // namespace

/// The HDF5 file while it grows.
class TraceWriter::File {
  public:
    File(const std::filesystem::path& temporary, std::string name, const TraceInfo& info, int deflate);
    void add(const Particles& particles, const CollisionImage* cdt);
    void finish();

  private:
    /// A dataset that gets row after row.
    struct Rows {
        Id set;
        Extents extents;
        hsize_t count = 0;
    };

    [[nodiscard]] Id dataset_creation() const;
    [[nodiscard]] Id make_group(const std::string& path) const;
    void write_text(const std::string& path, const std::string& text) const;
    void write_attribute(hid_t object, const char* name, const std::string& text) const;
    void write_attribute(hid_t object, const char* name, hid_t type, const std::vector<int>& values) const;
    template <class Value> void write_array(const std::string& path, hid_t type, const Extents& extents,
                                            const std::vector<Value>& values) const;
    [[nodiscard]] Rows make_rows(const std::string& path, hid_t type, const Extents& extents,
                                 hsize_t rows_a_chunk) const;
    void append(Rows& rows, hid_t memory_type, const void* values) const;
    void append_particles(const Particles& particles);
    void make_steps(const char* element, Rows& step, Rows& time) const;
    void write_head() const;
    void write_run(const TraceInfo& info) const;

    std::string name_; ///< to complain about
    int deflate_;
    double tick_;
    Id links_; ///< makes the groups on the way to a new object
    Id file_;
    std::vector<Rows> fields_;
    Rows step_, time_, cdt_, cdt_step_, cdt_time_;
};

TraceWriter::File::File(const std::filesystem::path& temporary, std::string name, const TraceInfo& info, int deflate)
    : name_(std::move(name)), deflate_(deflate), tick_(info.scene.constants.tick) {
    hdf5::quieten();
    const Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, name_);
    expect(H5Pset_userblock(creation.get(), seal_size), name_);
    links_ = Id(H5Pcreate(H5P_LINK_CREATE), H5Pclose, name_);
    expect(H5Pset_create_intermediate_group(links_.get(), 1), name_);
    // As HDF5 before 2.0 has it: the newer forms keep the time at which a group was made.
    const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, name_);
    expect(H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), name_);
    check_room(temporary, name_);
    file_ = Id(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose, name_);
    write_head();
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

/// What H5MD asks of every file.
void TraceWriter::File::write_head() const {
    const Id h5md = make_group("h5md");
    write_attribute(h5md.get(), "version", H5T_STD_I32LE, {1, 1});
    const Id author = make_group("h5md/author");
    write_attribute(author.get(), "name", "unknown");
    const Id creator = make_group("h5md/creator");
    write_attribute(creator.get(), "name", "lockstep");
    write_attribute(creator.get(), "version", LOCKSTEP_VERSION);
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

/// The same run is the same file, whenever it is written.
Id TraceWriter::File::dataset_creation() const {
    Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name_);
    expect(H5Pset_obj_track_times(creation.get(), 0), name_);
    return creation;
}

Id TraceWriter::File::make_group(const std::string& path) const {
    return {H5Gcreate2(file_.get(), path.c_str(), links_.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name_};
}

void TraceWriter::File::write_text(const std::string& path, const std::string& text) const {
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose, name_);
    expect(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), name_);
    expect(H5Tset_cset(type.get(), H5T_CSET_UTF8), name_);
    const Id space(H5Screate(H5S_SCALAR), H5Sclose, name_);
    const Id set(H5Dcreate2(file_.get(), path.c_str(), type.get(), space.get(), links_.get(), dataset_creation().get(),
                            H5P_DEFAULT),
                 H5Dclose, name_);
    expect(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), name_);
}

void TraceWriter::File::write_attribute(hid_t object, const char* name, const std::string& text) const {
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose, name_);
    expect(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), name_);
    const Id space(H5Screate(H5S_SCALAR), H5Sclose, name_);
    const Id attribute(H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name_);
    expect(H5Awrite(attribute.get(), type.get(), text.c_str()), name_);
}

void TraceWriter::File::write_attribute(hid_t object, const char* name, hid_t type,
                                        const std::vector<int>& values) const {
    const hsize_t count = values.size();
    const Id space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose, name_);
    const Id attribute(H5Acreate2(object, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name_);
    expect(H5Awrite(attribute.get(), H5T_NATIVE_INT, values.data()), name_);
}

template <class Value> void TraceWriter::File::write_array(const std::string& path, hid_t type, const Extents& extents,
                                                           const std::vector<Value>& values) const {
    const Id space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose, name_);
    const Id creation = dataset_creation();
    Extents chunk = extents;
    chunk[0] = std::min<hsize_t>(chunk[0], largest_chunk / 16);
    expect(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()), name_);
    expect(H5Pset_shuffle(creation.get()), name_);
    expect(H5Pset_deflate(creation.get(), static_cast<unsigned>(deflate_)), name_);
    expect(H5Pset_fletcher32(creation.get()), name_);
    const Id set(H5Dcreate2(file_.get(), path.c_str(), type, space.get(), links_.get(), creation.get(), H5P_DEFAULT),
                 H5Dclose, name_);
    const hid_t memory = H5Tequal(type, H5T_IEEE_F32LE) > 0  ? H5T_NATIVE_FLOAT
                         : H5Tequal(type, H5T_STD_U32LE) > 0 ? H5T_NATIVE_UINT32
                                                             : type;
    expect(H5Dwrite(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name_);
}

TraceWriter::File::Rows TraceWriter::File::make_rows(const std::string& path, hid_t type, const Extents& extents,
                                                     hsize_t rows_a_chunk) const {
    Extents start{0}, most{H5S_UNLIMITED}, chunk{rows_a_chunk};
    start.insert(start.end(), extents.begin(), extents.end());
    most.insert(most.end(), extents.begin(), extents.end());
    chunk.insert(chunk.end(), extents.begin(), extents.end());
    hsize_t bytes = H5Tget_size(type);
    for (std::size_t i = 1; i < chunk.size(); ++i)
        bytes *= chunk[i];
    if (bytes > largest_chunk && chunk.size() > 1)
        chunk[1] = std::max<hsize_t>(1, chunk[1] * largest_chunk / bytes);

    const Id space(H5Screate_simple(static_cast<int>(start.size()), start.data(), most.data()), H5Sclose, name_);
    const Id creation = dataset_creation();
    expect(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()), name_);
    expect(H5Pset_shuffle(creation.get()), name_);
    expect(H5Pset_deflate(creation.get(), static_cast<unsigned>(deflate_)), name_);
    expect(H5Pset_fletcher32(creation.get()), name_);
    return {{H5Dcreate2(file_.get(), path.c_str(), type, space.get(), links_.get(), creation.get(), H5P_DEFAULT),
             H5Dclose, name_},
            extents};
}

void TraceWriter::File::append(Rows& rows, hid_t memory_type, const void* values) const {
    Extents whole{rows.count + 1}, start(rows.extents.size() + 1, 0), block{1};
    whole.insert(whole.end(), rows.extents.begin(), rows.extents.end());
    block.insert(block.end(), rows.extents.begin(), rows.extents.end());
    start[0] = rows.count;
    expect(H5Dset_extent(rows.set.get(), whole.data()), name_);
    const Id file_space(H5Dget_space(rows.set.get()), H5Sclose, name_);
    expect(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), name_);
    const Id memory_space(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose, name_);
    expect(H5Dwrite(rows.set.get(), memory_type, memory_space.get(), file_space.get(), H5P_DEFAULT, values), name_);
    ++rows.count;
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

void TraceWriter::File::finish() { expect(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), name_); }

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
