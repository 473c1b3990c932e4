#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/mesh.hpp"

namespace lockstep {

/// Triangles before they are placed in the world: doubles, so that placing rounds once.
struct Surface {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> indices; ///< three a triangle, counter-clockwise seen from outside
};

/// A rectangle in the plane y = 0, facing up. `size`: along x and along z.
Surface plane_surface(double size_x, double size_z);

/// All sides of a box around the origin.
Surface box_surface(glm::dvec3 size);

/// An octahedron around the origin, each face split into segments^2 triangles and pushed out to the sphere.
Surface sphere_surface(double radius, int segments);

/// A ring in the plane y = 0 around the origin: `segments` tubes of half as many sides.
Surface torus_surface(double radius, double tube_radius, int segments);

/// The triangles of an OBJ or PLY file, in the file's order, equal vertices merged. Throws Error if the file is
/// missing, is of another kind, cut off, has no faces, one of over 1,024 corners, or a coordinate that is not a finite
/// number. Other files that it names are not read.
Surface load_surface(const std::filesystem::path& file);

/// Where a surface stands.
struct Placement {
    double height = 0.0;      ///< of its bounding box, by scaling evenly; 0: as it is
    double rotate_y = 0.0;    ///< degrees about the vertical axis
    glm::dvec3 position{0.0}; ///< where the centre of the (unrotated) bounding box comes to lie
};

/// Adds the placed surface to `mesh`. Throws Error where a flat one is to have a height, or a float cannot hold it.
void place(const Surface& surface, const Placement& placement, Mesh& mesh);

} // namespace lockstep
