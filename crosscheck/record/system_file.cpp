#include "crosscheck/record/system_file.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/record/layout.hpp"
#include "crosscheck/record/state_extents.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

using hdf5::Extents;

SystemFile::Columns SystemFile::columns(std::uint8_t resource) {
    const Resource& about = state_.schema().resources[resource];
    Columns columns;
    columns.frames = integers(layout::state(about) + "/frame");
    columns.passes = integers(layout::state(about) + "/pass");
    std::size_t rows = std::min(columns.frames.size(), columns.passes.size()), most = rows;
    for (const Field& field : about.fields) {
        const Extents right = row_extents(about, field, state_.extent(resource));
        Dataset dataset =
            values(layout::state_value(about, field), field.scalar, fmt::format("[rows][{}]", fmt::join(right, "][")),
                   Extents(right.begin() + 1, right.end()));
        if (dataset.extents != right)
            hdf5::fail(dataset.path, fmt::format("a row has [{}]; this run's has [{}]",
                                                 fmt::join(dataset.extents, "]["), fmt::join(right, "][")));
        Extents whole{dataset.rows};
        whole.insert(whole.end(), right.begin(), right.end());
        if (dataset.rows > 0)
            hdf5::expect_stored(dataset.set.get(), whole, sizeof(float), dataset.path);
        rows = std::min<std::size_t>(rows, dataset.rows);
        most = std::max<std::size_t>(most, dataset.rows);
        columns.fields.push_back(std::move(dataset));
    }
    if (rows == 0)
        hdf5::fail(layout::state(about), "has no whole row; right is the start and one for each pass that wrote it");
    if (rows < most)
        warnings_.push_back(
            fmt::format("{}: some of its columns have {} rows, others {}", layout::state(about), rows, most));
    columns.frames.resize(rows);
    columns.passes.resize(rows);
    return columns;
}

void SystemFile::serve(ReadingEnd& end) {
    end.put_up_fence();
    std::size_t largest = 0;
    for (std::uint8_t r = 0; r < state_.schema().resources.size(); ++r) {
        resources_.push_back(columns(r));
        largest = std::max(largest, state_.extent(r).count() * item_bytes(state_.schema().resources[r]));
    }
    end.allow(2 * largest, warnings_);
    const nlohmann::json told{{"warnings", warnings_}};
    end.send(MessageKind::contents, told.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    for (const Columns& columns : resources_) {
        end.send(MessageKind::frames, columns.frames);
        end.send(MessageKind::passes, columns.passes);
    }
    std::vector<std::byte> bytes;
    Request request;
    while (end.next(request)) {
        if (request.kind != MessageKind::row || request.resource >= resources_.size() ||
            request.index >= resources_[request.resource].frames.size())
            throw Error(fmt::format("row {} of {} was asked for", request.index, request.resource));
        const Columns& columns = resources_[request.resource];
        const Resource& about = state_.schema().resources[request.resource];
        const std::size_t count = state_.extent(static_cast<std::uint8_t>(request.resource)).count();
        bytes.resize(count * item_bytes(about));
        std::byte* into = bytes.data();
        for (std::size_t f = 0; f < columns.fields.size(); ++f) {
            read_row(columns.fields[f], request.index, into);
            into += count * sizeof(std::uint32_t) * static_cast<std::size_t>(about.fields[f].components);
        }
        end.send({request.kind, request.index, bytes.size()}, bytes.data());
    }
}

} // namespace lockstep
