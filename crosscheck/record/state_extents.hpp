#pragma once
#include "crosscheck/record/hdf5.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// What a row of a field has: layers where there are three dimensions, height where there are two, width or items, and
/// components where there are several.
inline hdf5::Extents row_extents(const Resource& resource, const Field& field, const Extent& extent) {
    hdf5::Extents extents;
    if (resource.dimensions == 3)
        extents.push_back(extent.depth);
    if (resource.dimensions > 1)
        extents.push_back(extent.height);
    extents.push_back(extent.width);
    if (field.components > 1)
        extents.push_back(static_cast<hsize_t>(field.components));
    return extents;
}

} // namespace lockstep
