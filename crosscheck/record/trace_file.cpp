#include "crosscheck/record/trace_file.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/scene/scene_file.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using hdf5::expect;
using hdf5::expect_stored;
using hdf5::Extents;
using hdf5::extents_of;
using hdf5::fail;
using hdf5::Id;
using hdf5::is_float32;
using hdf5::is_integer;
using hdf5::shape;
using hdf5::type_name;

constexpr hsize_t widest_cdt = 16384;            // texels
constexpr hsize_t highest_cdt = 36 * widest_cdt; // all planes of layered_cdt.hpp
constexpr hsize_t most_corners = 3 * most_triangles;

/// "position, direction, speed and collide_time".
std::string field_list(const Resource& buffer) {
    std::string list;
    for (std::size_t f = 0; f < buffer.fields.size(); ++f)
        list += fmt::format("{}{}",
                            f == 0                          ? ""
                            : f + 1 == buffer.fields.size() ? " and "
                                                            : ", ",
                            buffer.fields[f].name);
    return list;
}

} // namespace

TraceFile::TraceFile(const OpenedFile& file, const Resource& buffer) : RecordedFile(file), buffer_(&buffer) {}

void TraceFile::look_at_contents() {
    find_head();
    find_velocity();
    find_cdt(find_particles());
}

void TraceFile::find_velocity() {
    has_velocity_ = exists(layout::velocity);
    if (!has_velocity_)
        return;
    for (const Field& field : buffer_->fields)
        if (const std::string path = layout::value(*buffer_, field); path_of(field) != path && exists(path))
            fail(layout::velocity, fmt::format("is there beside {}; right is the velocity as one vector, or direction "
                                               "and speed, not both",
                                               path));
}

std::string TraceFile::path_of(const Field& field) const {
    if (has_velocity_ && field.name == "direction")
        return layout::velocity;
    return has_velocity_ && field.name == "speed" ? "" : layout::value(*buffer_, field);
}

/// Gives the rows of the longest field.
std::size_t TraceFile::find_particles() {
    hsize_t fewest = hsize_t{1} << 32U, most = 0;
    const Dataset* shortest = nullptr;
    const std::size_t fields = buffer_->fields.size();
    fields_.reserve(fields); // `shortest` points into it
    for (std::size_t f = 0; f < fields; ++f) {
        const Field& field = buffer_->fields[f];
        const std::string right = fmt::format("[rows][{}s]", buffer_->item);
        const std::string path = path_of(field);
        if (path.empty()) {
            fields_.emplace_back();
            continue;
        }
        fields_.push_back(field.components == 1
                              ? values(path, field.scalar, right, {})
                              : values(path, field.scalar, fmt::format("{}[{}]", right, field.components),
                                       {static_cast<hsize_t>(field.components)}));
        const Dataset& dataset = fields_.back();
        const hsize_t count = dataset.extents[0];
        if (count < 1 || count > most_particles)
            fail(dataset.path, fmt::format("has {} particles; right is 1 to {}", count, most_particles));
        if (f > 0 && count != particles_)
            fail(dataset.path, fmt::format("has {} particles, {} has {}", count, fields_[0].path, particles_));
        particles_ = count;
        if (dataset.rows < fewest || shortest == nullptr) {
            fewest = dataset.rows;
            shortest = &dataset;
        }
        most = std::max(most, dataset.rows);
        Extents whole{dataset.rows};
        whole.insert(whole.end(), dataset.extents.begin(), dataset.extents.end());
        if (dataset.rows > 0)
            expect_stored(dataset.set.get(), whole, sizeof(float), dataset.path);
    }
    if (fewest < 2)
        fail(shortest->path, fmt::format("has {} rows; right is the start and a row a frame, so 2 or more", fewest));
    rows_ = fewest;
    if (most > fewest)
        warnings_.push_back(fmt::format("{}: has {} rows, another of {} has {}: read up to the last whole frame, {}",
                                        shortest->path, fewest, field_list(*buffer_), most, fewest - 2));
    return most;
}

void TraceFile::find_cdt(std::size_t rows_of_particles) {
    if (!exists(layout::cdt))
        return;
    // One extent more than `last` names: the height.
    const Id probe = open_dataset(layout::cdt);
    const Extents found = extents_of(probe.get(), layout::cdt);
    const hsize_t width = found.size() == 4 ? found[2] : 0;
    cdt_ = values(layout::cdt, Scalar::float32, "[frames][height][width][4]", {width, 4});
    if (cdt_.extents[0] < 1 || width < 1 || cdt_.extents[0] > highest_cdt || width > widest_cdt)
        fail(cdt_.path,
             fmt::format("has {}x{} texels; right is the size of the scene's image", width, cdt_.extents[0]));
    if (cdt_.rows == 0)
        fail(cdt_.path, "has no rows; right is one a frame, or no CDT at all");
    expect_stored(cdt_.set.get(), found, sizeof(float), cdt_.path);
    if (cdt_.rows + 1 < rows_) {
        warnings_.push_back(fmt::format("{}: has {} frames, the particles have {}: read up to the last whole frame, {}",
                                        cdt_.path, cdt_.rows, rows_ - 1, cdt_.rows - 1));
        rows_ = cdt_.rows + 1;
    } else if (cdt_.rows + 1 > rows_of_particles) {
        warnings_.push_back(fmt::format("{}: has {} frames, the particles have {}: read up to the last whole frame, {}",
                                        cdt_.path, cdt_.rows, rows_ - 1, rows_ - 2));
    }
}

std::size_t TraceFile::cdt_bytes() const {
    return has_cdt() ? static_cast<std::size_t>(cdt_.extents[0] * cdt_.extents[1]) * 16 : 0;
}

void TraceFile::read_particles(std::size_t row, std::byte* into) {
    for (std::size_t f = 0; f < fields_.size(); ++f) {
        const std::size_t bytes = particles_ * sizeof(float) * static_cast<std::size_t>(buffer_->fields[f].components);
        if (fields_[f].path.empty()) {
            const std::vector<float> ones(particles_, 1.0F);
            std::memcpy(into, ones.data(), bytes);
        } else {
            read_row(fields_[f], row, into);
        }
        into += bytes;
    }
}

void TraceFile::read_cdt(std::size_t frame, std::byte* into) { read_row(cdt_, frame, into); }

std::vector<std::int32_t> TraceFile::counts() const {
    if (!exists(layout::counts))
        return {};
    std::vector<std::int32_t> all = integers(layout::counts);
    if (all.size() + 1 < rows_)
        fail(layout::counts, fmt::format("has {} frames; right is one of each, so {}", all.size(), rows_ - 1));
    all.resize(rows_ - 1);
    for (std::size_t frame = 0; frame < all.size(); ++frame)
        if (all[frame] < 0 || static_cast<std::size_t>(all[frame]) > particles_)
            fail(layout::counts,
                 fmt::format("frame {}: {}; right is 0 to {}, the particles", frame, all[frame], particles_));
    return all;
}

std::vector<float> TraceFile::obstacle_positions() const {
    const std::string path = layout::obstacle_positions;
    if (!exists(path))
        return {};
    const Id set = open_dataset(path);
    const Id type(H5Dget_type(set.get()), H5Tclose, path);
    const Extents extents = extents_of(set.get(), path);
    if (!is_float32(type.get()) || extents.size() != 2 || extents[1] != 3 || extents[0] > most_corners)
        fail(path, fmt::format("is {}; right is float32 [corners][3], at most {}",
                               shape(type_name(type.get()), extents), most_corners));
    expect_stored(set.get(), extents, sizeof(float), path);
    return hdf5::read_all<float>(set.get(), H5T_NATIVE_FLOAT, extents[0] * 3, path);
}

std::vector<std::uint32_t> TraceFile::obstacle_triangles() const {
    const std::string path = layout::obstacle_triangles;
    if (!exists(path))
        return {};
    const Id set = open_dataset(path);
    const Id type(H5Dget_type(set.get()), H5Tclose, path);
    const Extents extents = extents_of(set.get(), path);
    if (!is_integer(type.get(), 4, H5T_SGN_NONE) || extents.size() != 2 || extents[1] != 3 ||
        extents[0] > most_triangles)
        fail(path, fmt::format("is {}; right is uint32 [triangles][3], at most {}",
                               shape(type_name(type.get()), extents), most_triangles));
    expect_stored(set.get(), extents, sizeof(std::uint32_t), path);
    return hdf5::read_all<std::uint32_t>(set.get(), H5T_NATIVE_UINT32, extents[0] * 3, path);
}

} // namespace lockstep
