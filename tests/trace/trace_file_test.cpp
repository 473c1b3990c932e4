#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <hdf5.h>

#include "crosscheck/collision/record/trace_reader.hpp"
#include "crosscheck/record/hdf5.hpp"
#include "crosscheck/record/layout.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "crosscheck/record/seal.hpp"
#include "reference/model/same_bits.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::trace_file_test {

using Catch::Contains;
using Catch::StartsWith;

namespace {

// By hand: what files of old have (docs/traces.md).
constexpr const char* position = "particles/all/position/value";
constexpr const char* speed = "particles/all/speed/value";

constexpr int frames = 3;

bool same_bits(const Particles& a, const Particles& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!lockstep::same_bits(a[i], b[i]))
            return false;
    return a.size() == b.size();
}

/// A trace that is changed through HDF5 and sealed again.
class Changed {
  public:
    explicit Changed(bool has_cdt = true) { test::record(file_, test::small_info(has_cdt), frames); }

    Changed& remove(const char* path) {
        return with_file([&](hid_t file) { REQUIRE(H5Ldelete(file, path, H5P_DEFAULT) >= 0); });
    }
    /// A dataset of zeros in the place of what is there.
    Changed& replace(const char* path, hid_t type, std::vector<hsize_t> extents, bool written = true) {
        remove(path);
        return with_file([&](hid_t file) {
            const hid_t space = extents.empty()
                                    ? H5Screate(H5S_SCALAR)
                                    : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr);
            const hid_t set = H5Dcreate2(file, path, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
            REQUIRE(set >= 0);
            std::size_t bytes = H5Tget_size(type);
            for (const hsize_t extent : extents)
                bytes *= extent;
            if (written)
                REQUIRE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, std::vector<char>(bytes).data()) >= 0);
            H5Dclose(set);
            H5Sclose(space);
        });
    }
    Changed& replace_text(const char* path, const std::string& text) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, text.size() + 1);
        remove(path);
        with_file([&](hid_t file) {
            const hid_t space = H5Screate(H5S_SCALAR);
            const hid_t set = H5Dcreate2(file, path, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
            REQUIRE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0);
            H5Dclose(set);
            H5Sclose(space);
        });
        H5Tclose(type);
        return *this;
    }
    Changed& resize(const char* path, std::vector<hsize_t> extents) {
        return with_file([&](hid_t file) {
            const hid_t set = H5Dopen2(file, path, H5P_DEFAULT);
            REQUIRE(H5Dset_extent(set, extents.data()) >= 0);
            H5Dclose(set);
        });
    }
    Changed& with_file(const std::function<void(hid_t)>& change) {
        hdf5::quieten();
        const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        REQUIRE(file >= 0);
        change(file);
        H5Fclose(file);
        seal_file(file_);
        return *this;
    }

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] std::string refusal() const {
        return test::error_of([&] {
            TraceReader trace(file_);
            Particles particles;
            CollisionImage cdt;
            for (int frame = 0; frame < trace.info().frames; ++frame) {
                trace.read(frame, particles);
                if (trace.info().has_cdt)
                    trace.read(frame, cdt);
            }
        });
    }

  private:
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "run.h5";
};

} // namespace

TEST_CASE("trace: a few kilobytes cannot ask for gigabytes, of texels, triangles or stored obstacles") {
    Changed changed(false);
    changed.replace_text(layout::scene, R"({"image": [16384, 16384]})");
    CHECK_THAT(changed.refusal(), Contains("run.h5: asks for about 25.0 GiB of memory, for 268435456 texels and 60 "
                                           "particles; a file of ") &&
                                      Contains("may ask for 2.0 (LOCKSTEP_FILE_MEMORY=GIB allows more)"));
    std::string spheres = R"({"shape": "sphere", "radius": 1, "segments": 512})";
    for (int i = 1; i < 200; ++i)
        spheres += R"(, {"shape": "sphere", "radius": 1, "segments": 512})";
    changed.replace_text(layout::scene, R"({"obstacles": [)" + spheres + "]}")
        .remove(layout::obstacle_positions)
        .remove(layout::obstacle_triangles);
    CHECK_THAT(changed.refusal(), Contains("/obstacles/2: 6291456 triangles up to here; a scene has at most 4194304"));
    Changed stored(false);
    stored.replace(layout::obstacle_triangles, H5T_STD_U32LE, {4194305, 3}, false);
    CHECK_THAT(stored.refusal(), Contains("is uint32 [4194305][3]; right is uint32 [triangles][3], at most 4194304"));
}

TEST_CASE("trace: texts that are shown cannot pass for lines of a report, nor steer a terminal") {
    Changed changed;
    const std::string forged = "x\nverdict   AGREE\x1b[2J\xe2\x80\xae\xff";
    const std::string shown = "x\\nverdict   AGREE\\x1b[2J\\u202e";
    for (const char* path : {layout::renderer, layout::settings, layout::shaders, layout::name})
        changed.replace_text(path, forged);
    const TraceReader trace(changed.file());
    CHECK_THAT(trace.info().renderer, StartsWith(shown));
    CHECK_THAT(trace.info().settings, StartsWith(shown));
    CHECK_THAT(trace.info().shaders, StartsWith(shown));
    CHECK_THAT(trace.info().scene.name, StartsWith(shown));
}

TEST_CASE("trace: everything that is written is read back, states in any order") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    TraceInfo info = test::small_info(true);
    info.probe = "{}";
    std::vector<Particles> states;
    std::vector<CollisionImage> cdts;
    test::record(file, info, 5, [&](int, const Particles& particles, const CollisionImage& cdt) {
        states.push_back(particles);
        cdts.push_back(cdt);
    });
    TraceReader trace(file);
    const TraceInfo& read = trace.info();
    CHECK(read.frames == 5);
    CHECK(read.has_cdt);
    CHECK(read.scene.name == "small");
    CHECK(read.renderer == "a renderer");
    CHECK(read.settings == "the scene's");
    CHECK(read.shaders == "shipped");
    CHECK(read.probe == "{}");
    CHECK_THAT(read.program, StartsWith("lockstep "));
    CHECK(read.warnings.empty());
    CHECK(read.scene.obstacles.positions == info.scene.obstacles.positions);
    CHECK(read.scene.obstacles.indices == info.scene.obstacles.indices);
    CHECK(same_bits(read.scene.start, info.scene.start));
    REQUIRE(read.profile);
    CHECK(read.profile->name == "llvmpipe");
    Particles particles;
    CollisionImage cdt;
    for (const int frame : {0, 1, 4, 2, 2, 3, 0}) {
        trace.read(frame, cdt);
        trace.read(frame, particles);
        CHECK(same_bits(particles, states[static_cast<std::size_t>(frame)]));
        CHECK(cdt.texels == cdts[static_cast<std::size_t>(frame)].texels);
    }
    trace.read(-1, particles);
    CHECK(same_bits(particles, info.scene.start));
}

TEST_CASE("trace: NaN, infinities, subnormals and -0 keep their bits") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    const std::vector<std::uint32_t> bits{0x7fc00000, 0xffc12345, 0x7f800000, 0xff800000, 0x80000000, 1, 0x807fffff};
    test::record(file, test::small_info(false), 2, [&](int, Particles& particles, CollisionImage&) {
        for (std::size_t i = 0; i < bits.size(); ++i)
            particles.speed[i] = std::bit_cast<float>(bits[i]);
    });
    TraceReader trace(file);
    Particles particles;
    trace.read(1, particles);
    for (std::size_t i = 0; i < bits.size(); ++i)
        CHECK(std::bit_cast<std::uint32_t>(particles.speed[i]) == bits[i]);
}

TEST_CASE("trace: the driver's tables travel along") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    TraceInfo info = test::small_info(false);
    RootOffsets offsets{std::vector<std::int8_t>(reciprocal_count), std::vector<std::int8_t>(inverse_sqrt_count, -1)};
    offsets.reciprocal[12345] = 3;
    info.profile->roots = std::make_shared<const RootTables>(root_tables(offsets));
    test::record(file, info, 1);
    const TraceReader trace(file);
    REQUIRE(trace.info().profile->roots);
    CHECK(trace.info().profile->roots->reciprocal == info.profile->roots->reciprocal);
    CHECK(trace.info().profile->roots->inverse_sqrt == info.profile->roots->inverse_sqrt);
}

TEST_CASE("trace: values come out the same however they are stored") {
    struct Storage {
        std::vector<hsize_t> chunk; ///< empty: in one piece
        bool shuffle = false, deflate = false, checksum = false, big_endian = false;
    };
    const std::vector<Storage> storages{{},
                                        {{}, false, false, false, true},
                                        {{2, 7, 3}, true, true, true},
                                        {{1, 7, 3}, true, true, true},
                                        {{1, 60, 3}, true, true, false},
                                        {{1, 60, 2}, true, true, true},
                                        {{1, 60, 3}, false, true, true},
                                        {{1, 100, 3}, true, false, true},
                                        {{1, 60, 3}, true, true, true, true}};
    std::vector<float> values(4 * 60 * 3);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::ldexp(static_cast<float>(i) + 0.37F, static_cast<int>(i % 40) - 20);
    for (const Storage& storage : storages) {
        Changed changed(false);
        changed.remove(position).with_file([&](hid_t file) {
            const std::vector<hsize_t> extents{4, 60, 3}, most{H5S_UNLIMITED, H5S_UNLIMITED, 3};
            const bool chunked = !storage.chunk.empty();
            const hid_t space = H5Screate_simple(3, extents.data(), chunked ? most.data() : nullptr);
            const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
            if (chunked)
                H5Pset_chunk(creation, 3, storage.chunk.data());
            if (storage.shuffle)
                H5Pset_shuffle(creation);
            if (storage.deflate)
                H5Pset_deflate(creation, 6);
            if (storage.checksum)
                H5Pset_fletcher32(creation);
            const hid_t set = H5Dcreate2(file, position, storage.big_endian ? H5T_IEEE_F32BE : H5T_IEEE_F32LE, space,
                                         H5P_DEFAULT, creation, H5P_DEFAULT);
            REQUIRE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
            H5Dclose(set);
            H5Pclose(creation);
            H5Sclose(space);
        });
        TraceReader trace(changed.file());
        Particles particles;
        for (const int frame : {-1, 0, 1, 2}) {
            trace.read(frame, particles);
            const float* row = values.data() + (frame + 1) * 60 * 3;
            CHECK(std::equal(row, row + 60 * 3, &particles.position[0].x));
        }
    }
}

TEST_CASE("trace: a run that ends early leaves no file, and no name is taken twice") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    CHECK_THROWS(test::record(file, test::small_info(false), 3, [](int frame, Particles&, CollisionImage&) {
        if (frame == 1)
            throw std::runtime_error("the GPU is gone");
    }));
    CHECK(std::filesystem::is_empty(folder.path()));
    CHECK_THAT(test::error_of([&] { test::record(folder.path() / "no" / "run.h5", test::small_info(false), 1); }),
               Contains("cannot be written: No such file"));
    std::filesystem::create_symlink("/dev/null", folder.path() / "null");
    CHECK_THAT(test::error_of([&] { test::record(folder.path() / "null", test::small_info(false), 1); }),
               Contains("cannot be written: a trace is a regular file"));
}

TEST_CASE("trace: an error names the dataset, what it is and what would be right") {
    CHECK(Changed().refusal().empty());
    CHECK_THAT(Changed().remove(speed).refusal(),
               Contains("run.h5: particles/all/speed/value: missing; right is float32 [rows][particles]"));
    CHECK_THAT(Changed().replace(speed, H5T_NATIVE_DOUBLE, {4, 60}).refusal(),
               Contains("speed/value: is float64 [4][60]; right is float32 [rows][particles]"));
    CHECK_THAT(Changed().replace(speed, H5T_NATIVE_INT32, {4, 60}).refusal(), Contains("is int32 [4][60]"));
    CHECK_THAT(Changed().replace(speed, H5T_NATIVE_FLOAT, {4, 60, 1}).refusal(), Contains("is float32 [4][60][1]"));
    CHECK_THAT(Changed().replace(speed, H5T_NATIVE_FLOAT, {}).refusal(), Contains("is float32 scalar"));
    CHECK_THAT(Changed().replace(speed, H5T_NATIVE_FLOAT, {4, 59}).refusal(),
               Contains("speed/value: has 59 particles, particles/all/position/value has 60"));
    CHECK_THAT(Changed().replace(position, H5T_NATIVE_FLOAT, {4, 60, 4}).refusal(),
               Contains("is float32 [4][60][4]; right is float32 [rows][particles][3]"));
    CHECK_THAT(Changed().replace(speed, H5T_NATIVE_FLOAT, {1, 60}).refusal(),
               Contains("has 1 rows; right is the start and a row a frame, so 2 or more"));
    CHECK_THAT(Changed().replace(speed, H5T_NATIVE_FLOAT, {4, 60}, false).refusal(),
               Contains("speed/value: claims 240 values in 0 bytes"));
    CHECK_THAT(Changed().replace(layout::cdt, H5T_NATIVE_FLOAT, {3, 20, 24, 3}).refusal(),
               Contains("observables/cdt/value: is float32 [3][20][24][3]; right is float32 [frames]"));
    CHECK_THAT(Changed().replace(layout::cdt, H5T_NATIVE_FLOAT, {3, 24, 20, 4}).refusal(),
               Contains("observables/cdt/value: is 20x24 texels, the scene's is 24x20"));
    CHECK_THAT(Changed().remove(layout::scene).refusal(),
               Contains("parameters/lockstep/scene: missing; right is the text of a scene file"));
    CHECK_THAT(Changed().replace(layout::scene, H5T_NATIVE_INT32, {}).refusal(),
               Contains("scene: is int32 scalar; right is one text"));
    CHECK_THAT(Changed().replace_text(layout::scene, R"({"image": [24, 0]})").refusal(),
               Contains("run.h5: parameters/lockstep/scene: /image/1: 0 is not an integer from 1 to 16384"));
    CHECK_THAT(Changed().replace_text(layout::scene, "{").refusal(), Contains("scene:1:1: malformed JSON"));
    CHECK_THAT(Changed().replace_text(layout::profile, R"({"name": "x", "dot": 3})").refusal(),
               Contains("run.h5: parameters/lockstep/profile: /dot: 3 is not one of"));
    CHECK_THAT(Changed().replace(layout::obstacle_triangles, H5T_NATIVE_INT32, {2, 3}).refusal(),
               Contains("obstacles/triangles: is int32 [2][3]; right is uint32 [triangles][3], at most 4194304"));
    CHECK_THAT(Changed().replace(layout::obstacle_positions, H5T_NATIVE_FLOAT, {0, 3}).refusal(),
               Contains("obstacles/triangles: names corner 0, there are 0"));
}

TEST_CASE("trace: rows that are missing at the end are left out with a warning, never made up") {
    Changed fewer;
    fewer.resize(speed, {3, 60});
    CHECK(fewer.refusal().empty());
    const TraceReader trace(fewer.file());
    CHECK(trace.info().frames == 2);
    REQUIRE(trace.info().warnings.size() == 1);
    CHECK_THAT(trace.info().warnings[0], StartsWith("particles/all/speed/value: has 3 rows, another of position, "
                                                    "direction, speed and collide_time has 4: read up to the last "
                                                    "whole frame, 1"));
    Changed fewer_cdts;
    fewer_cdts.resize(layout::cdt, {2, 20, 24, 4});
    const TraceReader second(fewer_cdts.file());
    CHECK(second.info().frames == 2);
    REQUIRE(second.info().warnings.size() == 1);
    CHECK_THAT(second.info().warnings[0], StartsWith("observables/cdt/value: has 2 frames, the particles have 3"));

    // Longer than what was written: HDF5 would read zeros.
    CHECK_THAT(Changed().resize(speed, {5, 60}).resize(position, {5, 60, 3}).refusal(),
               Contains("position/value: only 4 of its 5 chunks were written"));
}

TEST_CASE("trace: values that lie in another file are not read") {
    Changed linked;
    const Changed other;
    linked.remove(speed).with_file([&](hid_t file) {
        REQUIRE(H5Lcreate_external(other.file().c_str(), speed, file, speed, H5P_DEFAULT, H5P_DEFAULT) >= 0);
    });
    CHECK_THAT(linked.refusal(), Contains("particles/all/speed/value: a link to another file"));

    Changed external;
    external.remove(speed).with_file([&](hid_t file) {
        const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_external(creation, "/etc/passwd", 0, 4 * 60 * 4);
        const std::vector<hsize_t> extents{4, 60};
        const hid_t space = H5Screate_simple(2, extents.data(), nullptr);
        H5Dclose(H5Dcreate2(file, speed, H5T_NATIVE_FLOAT, space, H5P_DEFAULT, creation, H5P_DEFAULT));
        H5Sclose(space);
        H5Pclose(creation);
    });
    CHECK_THAT(external.refusal(), Contains("speed/value: its values lie in another file; all of a trace is in one"));
}

TEST_CASE("trace: what is missing may be missing") {
    Changed bare(false);
    bare.remove("h5md")
        .remove(layout::name)
        .remove(layout::profile)
        .remove(layout::renderer)
        .remove(layout::settings)
        .remove(layout::shaders);
    CHECK(bare.refusal().empty());
    const TraceReader trace(bare.file());
    CHECK(!trace.info().profile);
    CHECK(trace.info().scene.name == "trace");
    CHECK(trace.info().program.empty());
    CHECK(trace.info().shaders.empty());
    REQUIRE(trace.info().warnings.size() == 1);
    CHECK_THAT(trace.info().warnings[0], StartsWith("h5md: missing"));
}

TEST_CASE("trace: obstacles may stand in the scene's text, but not as the name of a mesh file") {
    Changed described(false);
    described.remove("parameters/lockstep/obstacles")
        .replace_text(layout::scene, R"({"image": [24, 20], "obstacles": [{"shape": "plane", "size": [1, 2]}]})");
    CHECK(TraceReader(described.file()).info().scene.obstacles.triangle_count() == 2);
    Changed mesh(false);
    mesh.remove("parameters/lockstep/obstacles")
        .replace_text(layout::scene, R"({"obstacles": [{"shape": "mesh", "file": "/etc/passwd", "height": 1}]})");
    CHECK_THAT(mesh.refusal(), Contains("/obstacles/0/file: no mesh file is read here"));
}

TEST_CASE("trace: a velocity stands in the place of direction and speed, not beside them") {
    Changed both(false), moved(false);
    both.with_file([](hid_t file) {
        const hid_t links = H5Pcreate(H5P_LINK_CREATE);
        H5Pset_create_intermediate_group(links, 1);
        REQUIRE(H5Lcreate_hard(file, "particles/all/direction/value", file, layout::velocity, links, H5P_DEFAULT) >= 0);
        H5Pclose(links);
    });
    CHECK_THAT(both.refusal(), Contains("particles/all/velocity/value: is there beside particles/all/direction/value"));
    moved.with_file([](hid_t file) {
        REQUIRE(H5Lmove(file, "particles/all/direction", file, "particles/all/velocity", H5P_DEFAULT, H5P_DEFAULT) >=
                0);
        REQUIRE(H5Ldelete(file, "particles/all/speed", H5P_DEFAULT) >= 0);
    });
    TraceReader trace(moved.file());
    CHECK(trace.info().scene.switches.velocity == Velocity::vector);
    Particles particles;
    trace.read(2, particles);
    CHECK(particles.speed == std::vector<float>(particles.size(), 1.0F));
}

TEST_CASE("trace: settings of a frame that was not recorded are refused") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    TraceInfo info = test::small_info(false);
    info.scene.frames.push_back({.frame = 2, .constants = info.scene.constants});
    test::record(file, info, 3);
    CHECK(TraceReader(file).info().scene.frames.size() == 1);
    test::record(file, info, 2);
    CHECK_THAT(test::error_of([&] { TraceReader reader(file); }),
               Contains("parameters/lockstep/scene: /frames/0: frame 2; 2 were recorded, counted from 0"));
}

} // namespace lockstep::test::trace_file_test
