// Point models as files: our packed .pts, and PLY for other programs. Little-endian, the same bytes for the same model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>

#include "motion/pose.h"
#include "pointsample/point_model.h"

namespace pointsample {

// What is drawn of a point: 12 bytes.
struct PackedPoint {
    std::uint16_t x, y, z;           // unorm over the file's box
    std::int8_t normal_u, normal_v;  // octahedral, snorm
    std::uint8_t red, green, blue;   // sRGB-encoded
    model::Slot slot;
};
static_assert(sizeof(PackedPoint) == 12);

// A .pts file in memory as it lies on disk (docs/pts-format.md): mapped, checked (magic, version, sizes, checksum,
// every value's range) and then read in place. Its writer must replace files, as apps/output.h does, not write into
// them.
class PointsFile {
public:
    // Throws std::runtime_error: one line with the path, what was found and what was expected.
    explicit PointsFile(const std::filesystem::path& path);
    ~PointsFile();
    PointsFile(const PointsFile&) = delete;
    PointsFile& operator=(const PointsFile&) = delete;

    glm::dvec3 origin() const;                       // that the box is relative to [units]
    motion::Bounds box() const;                      // of the points [units]
    std::span<const PackedPoint> points() const;     // in the model's order
    const std::string& key() const { return key_; }  // what it was made from, as write_pts was told

    // Everything; written and read again it is the same bits. Exact, but for
    //   positions  half a step of the box / 65535 an axis
    //   normals    0.017 rad
    //   u, v       half a step of 1 / 65535
    //   weights    1 / 255; their sum is 1
    PointModel unpack() const;

private:
    void check() const;
    void check_values() const;

    void* bytes_ = nullptr;
    std::size_t size_ = 0;
    std::string key_;
};

// What unpack() of the model's file gives: for programs that may find it kept or not, and shall do the same.
PointModel as_stored(const PointModel& model);

// `key` may be anything up to 64 KiB. The model's lists are of one length, as PointModel says. 37 bytes a point, 41
// where some have a light of their own.
void write_pts(std::ostream& out, const PointModel& model, const std::string& key);

// x y z nx ny nz red green blue, in the model's order. x y z are doubles if the model's origin is not 0, which they
// contain.
enum class PlyFormat { ascii, binary_little_endian };
void write_ply(std::ostream& out, const PointModel& model, PlyFormat format);

}  // namespace pointsample
