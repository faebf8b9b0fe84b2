#include "pointsample/points_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ostream>
#include <system_error>
#include <vector>

#include "model/input_file.h"
#include "motion/octahedral.h"
#include "pointsample/points_layout.h"
#include "pointsample/points_pack.h"

namespace pointsample {
namespace {

using model::fail;

static_assert(sizeof(PackedPoint) == element_bytes[drawn_section]);
static_assert(sizeof(Coverage) == element_bytes[coverage_section]);

const PointsHeader& header_of(const void* bytes) {
    return *static_cast<const PointsHeader*>(bytes);
}

// Of what check() has passed.
template <typename Value>
std::span<const Value> section_of(const void* bytes, Section section) {
    const PointsHeader& header = header_of(bytes);
    static_assert(alignof(Value) <= points_alignment);
    const std::uint64_t count = section == coverage_section ? header.coverage : header.points;
    return {reinterpret_cast<const Value*>(static_cast<const char*>(bytes) + header.offsets[section]),
            static_cast<std::size_t>(count)};
}

using Barycentrics = std::array<std::uint16_t, 2>;
using Joints = std::array<std::uint16_t, 4>;
using Weights = std::array<std::uint8_t, 4>;

// That each lies in the file, without overflow; then that they are the one layout of these counts.
void check_layout(const PointsHeader& header, std::uint64_t size) {
    if (header.file_bytes != size)
        fail(std::to_string(size) + " bytes", std::to_string(header.file_bytes) + ", as its header says");
    if (header.points > size / bytes_per_point) fail(std::to_string(header.points) + " points", "as many as it holds");
    if (header.coverage > size / element_bytes[coverage_section])
        fail(std::to_string(header.coverage) + " entries of coverage", "as many as it holds");
    if (header.key_bytes > most_key_bytes)
        fail("a key of " + std::to_string(header.key_bytes) + " bytes", "at most 65536");
    const PointsLayout layout = layout_of(header.points, header.coverage, header.key_bytes, header.own_lights != 0);
    if (layout.file_bytes() != size)
        fail(std::to_string(size) + " bytes", std::to_string(layout.file_bytes()) + " for its counts");
    if (header.offsets != layout.offsets || header.own_lights != layout.own_lights)
        fail("sections at other places", "those of its counts");
}

void check_checksum(const void* bytes, std::uint64_t size) {
    std::uint64_t stored = 0;
    std::memcpy(&stored, static_cast<const char*>(bytes) + size - sizeof stored, sizeof stored);
    if (XXH3_64bits(bytes, static_cast<std::size_t>(size) - sizeof stored) != stored)
        fail("a checksum that differs", "that of its bytes; the file is damaged");
}

// Writes, counts and sums up.
class Writer {
public:
    explicit Writer(std::ostream& out) : out_(out), state_(XXH3_createState()) { XXH3_64bits_reset(state_); }
    ~Writer() { XXH3_freeState(state_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    void write(const void* bytes, std::size_t size) {
        out_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
        XXH3_64bits_update(state_, bytes, size);
        at_ += size;
    }
    void pad_to(std::uint64_t offset) {
        constexpr std::array<char, points_alignment> zeros{};
        write(zeros.data(), static_cast<std::size_t>(offset - at_));
    }
    void write_checksum() {
        const std::uint64_t sum = XXH3_64bits_digest(state_);
        out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
    }

    // value_of(i) for each of `count`.
    template <typename ValueOf>
    void write_section(std::uint64_t offset, std::size_t count, ValueOf value_of) {
        pad_to(offset);
        std::vector<decltype(value_of(std::size_t{0}))> block;
        constexpr std::size_t most = 4096;
        for (std::size_t i = 0; i < count; i += block.size()) {
            block.clear();
            while (block.size() < std::min(most, count - i)) block.push_back(value_of(i + block.size()));
            write(block.data(), block.size() * sizeof block[0]);
        }
    }

private:
    std::ostream& out_;
    XXH3_state_t* state_;
    std::uint64_t at_ = 0;
};

PackedPoint packed(const PointModel& model, std::size_t i, const motion::Bounds& box) {
    const glm::vec3& p = model.positions[i];
    const motion::OctahedralNormal normal = pack_normal(model.normals[i]);
    const glm::u8vec4& color = model.colors[i];
    return {pack_between(p.x, box.min.x, box.max.x),
            pack_between(p.y, box.min.y, box.max.y),
            pack_between(p.z, box.min.z, box.max.z),
            normal.u,
            normal.v,
            color.r,
            color.g,
            color.b,
            model.slots[i]};
}

PointsHeader header_for(const PointModel& model, const motion::Bounds& box, std::size_t key_bytes,
                        const PointsLayout& layout) {
    PointsHeader header{};
    header.magic = points_magic;
    header.version = points_version;
    header.byte_order = points_byte_order;
    header.file_bytes = layout.file_bytes();
    header.points = model.size();
    header.coverage = model.coverage.size();
    header.hidden_removed = model.hidden_removed;
    header.box_min = {box.min.x, box.min.y, box.min.z};
    header.box_max = {box.max.x, box.max.y, box.max.z};
    header.area = model.area;
    header.key_bytes = static_cast<std::uint32_t>(key_bytes);
    header.offsets = layout.offsets;
    header.own_lights = layout.own_lights;
    header.origin = {model.origin.x, model.origin.y, model.origin.z};
    return header;
}

// -0 and 0 are one place, and shall be the same bytes.
motion::Bounds box_of(const PointModel& model) {
    motion::Bounds box = motion::bounds_of(model.positions);
    box.min += 0.0f;
    box.max += 0.0f;
    return box;
}

glm::vec3 position_of(const PackedPoint& point, const motion::Bounds& box) {
    return {unpack_between(point.x, box.min.x, box.max.x), unpack_between(point.y, box.min.y, box.max.y),
            unpack_between(point.z, box.min.z, box.max.z)};
}

}  // namespace

PointsFile::PointsFile(const std::filesystem::path& path) {
    model::with_name(path, [&] {
        const model::InputFile file(path, "a .pts file");
        size_ = static_cast<std::size_t>(file.left());
        if (size_ < layout_of(0, 0, 0, false).file_bytes())
            fail(std::to_string(size_) + " bytes",
                 "a .pts file, of at least " + std::to_string(layout_of(0, 0, 0, false).file_bytes()));
        bytes_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
        if (bytes_ == MAP_FAILED)
            fail("a file that can't be mapped (" + std::generic_category().message(errno) + ")", "a .pts file");
        try {
            check();
        } catch (...) {
            munmap(bytes_, size_);
            throw;
        }
        const PointsHeader& header = header_of(bytes_);
        key_.assign(static_cast<const char*>(bytes_) + header.offsets[key_section], header.key_bytes);
    });
}

PointsFile::~PointsFile() {
    munmap(bytes_, size_);
}

void PointsFile::check() const {
    const PointsHeader& header = header_of(bytes_);
    if (header.magic != points_magic) fail("a file of another kind", "a .pts file");
    if (header.byte_order != points_byte_order) fail("another byte order", "little-endian");
    if (header.version != points_version)
        fail("version " + std::to_string(header.version), "version " + std::to_string(points_version));
    check_layout(header, size_);
    check_checksum(bytes_, size_);
    check_values();
}

// A file may be made to harm, with a checksum that fits.
void PointsFile::check_values() const {
    const PointsHeader& header = header_of(bytes_);
    for (std::size_t i = 0; i < 3; ++i)
        if (!std::isfinite(header.box_min[i]) || !std::isfinite(header.box_max[i]) ||
            header.box_min[i] > header.box_max[i])
            fail("a box that is none", "its least before its greatest corner");
    for (const double coordinate : header.origin)
        if (!std::isfinite(coordinate)) fail("an origin that is no place", "finite numbers");
    if (!(header.area >= 0.0f) || !std::isfinite(header.area)) fail("no area", "a number from 0");
    for (const PackedPoint& point : points()) {
        if (point.normal_u == -128 || point.normal_v == -128) fail("a normal beyond -1", "-127 to 127");
        if (point.slot > model::slot_count)
            fail("slot " + std::to_string(point.slot), "at most " + std::to_string(model::slot_count));
    }
    for (const Barycentrics& uv : section_of<Barycentrics>(bytes_, uv_section))
        if (std::uint32_t{uv[0]} + uv[1] > model::unorm_steps)
            fail("a point outside its triangle", "u + v of at most 1");
    for (const Weights& weights : section_of<Weights>(bytes_, weight_section))
        if (weights[0] + weights[1] + weights[2] + weights[3] != 255) fail("weights that do not sum to 1", "they do");
    for (const float spacing : section_of<float>(bytes_, spacing_section))
        if (!(spacing >= 0.0f)) fail("a spacing that is no distance", "a number from 0");
    std::uint32_t before = 0;
    for (const Coverage& entry : section_of<Coverage>(bytes_, coverage_section)) {
        if (entry.points <= before || entry.points > header.points || !(entry.radius >= 0.0f))
            fail("coverage out of order", "rising counts of points, and radii from 0");
        before = entry.points;
    }
}

motion::Bounds PointsFile::box() const {
    const PointsHeader& header = header_of(bytes_);
    return {{header.box_min[0], header.box_min[1], header.box_min[2]},
            {header.box_max[0], header.box_max[1], header.box_max[2]}};
}

glm::dvec3 PointsFile::origin() const {
    const PointsHeader& header = header_of(bytes_);
    return {header.origin[0], header.origin[1], header.origin[2]};
}

std::span<const PackedPoint> PointsFile::points() const {
    return section_of<PackedPoint>(bytes_, drawn_section);
}

PointModel PointsFile::unpack() const {
    const PointsHeader& header = header_of(bytes_);
    const motion::Bounds whole = box();
    const auto triangles = section_of<std::uint32_t>(bytes_, triangle_section);
    const auto uvs = section_of<Barycentrics>(bytes_, uv_section);
    const auto alphas = section_of<std::uint8_t>(bytes_, alpha_section);
    PointModel model;
    for (std::size_t i = 0; i < points().size(); ++i) {
        const PackedPoint& point = points()[i];
        const glm::vec2 uv = unpack_barycentrics(uvs[i]);
        model.surface.push_back({triangles[i], uv.x, uv.y});
        model.positions.push_back(position_of(point, whole));
        model.normals.push_back(motion::unpack_normal(motion::OctahedralNormal{point.normal_u, point.normal_v}));
        model.colors.emplace_back(point.red, point.green, point.blue, alphas[i]);
        model.slots.push_back(point.slot);
    }
    for (const Joints& joints : section_of<Joints>(bytes_, joint_section))
        model.joints.emplace_back(joints[0], joints[1], joints[2], joints[3]);
    for (const Weights& weights : section_of<Weights>(bytes_, weight_section))
        model.weights.push_back(unpack_weights(weights));
    if (header.own_lights != 0) {
        const auto* first = reinterpret_cast<const glm::u8vec4*>(static_cast<const char*>(bytes_) + header.own_lights);
        model.own_lights.assign(first, first + header.points);
    }
    const auto spacing = section_of<float>(bytes_, spacing_section);
    model.spacing.assign(spacing.begin(), spacing.end());
    const auto coverage = section_of<Coverage>(bytes_, coverage_section);
    model.coverage.assign(coverage.begin(), coverage.end());
    model.origin = origin();
    model.area = header.area;
    model.hidden_removed = static_cast<std::size_t>(header.hidden_removed);
    return model;
}

PointModel as_stored(const PointModel& model) {
    const motion::Bounds box = box_of(model);
    PointModel stored = model;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const PackedPoint point = packed(model, i, box);
        const glm::vec2 uv = unpack_barycentrics(pack_barycentrics(model.surface[i].u, model.surface[i].v));
        stored.surface[i] = {model.surface[i].triangle, uv.x, uv.y};
        stored.positions[i] = position_of(point, box);
        stored.normals[i] = motion::unpack_normal(motion::OctahedralNormal{point.normal_u, point.normal_v});
        stored.weights[i] = unpack_weights(pack_weights(model.weights[i]));
    }
    return stored;
}

void write_pts(std::ostream& out, const PointModel& model, const std::string& key) {
    const std::size_t count = model.size();
    assert(key.size() <= most_key_bytes);
    assert(model.surface.size() == count && model.normals.size() == count && model.colors.size() == count &&
           model.slots.size() == count && model.joints.size() == count && model.weights.size() == count &&
           model.spacing.size() == count && (model.own_lights.empty() || model.own_lights.size() == count));
    const motion::Bounds box = box_of(model);
    const bool has_own_lights = !model.own_lights.empty();
    const PointsLayout layout = layout_of(count, model.coverage.size(), key.size(), has_own_lights);
    const PointsHeader header = header_for(model, box, key.size(), layout);
    Writer writer(out);
    writer.write(&header, sizeof header);
    writer.pad_to(layout.offsets[key_section]);
    writer.write(key.data(), key.size());
    const auto section = [&](Section which, std::size_t size, auto value_of) {
        writer.write_section(layout.offsets[which], size, value_of);
    };
    section(drawn_section, count, [&](std::size_t i) { return packed(model, i, box); });
    section(triangle_section, count, [&](std::size_t i) { return model.surface[i].triangle; });
    section(uv_section, count,
            [&](std::size_t i) { return pack_barycentrics(model.surface[i].u, model.surface[i].v); });
    section(joint_section, count, [&](std::size_t i) { return model.joints[i]; });
    section(weight_section, count, [&](std::size_t i) { return pack_weights(model.weights[i]); });
    section(spacing_section, count, [&](std::size_t i) { return model.spacing[i]; });
    section(alpha_section, count, [&](std::size_t i) { return model.colors[i].a; });
    section(coverage_section, model.coverage.size(), [&](std::size_t i) { return model.coverage[i]; });
    if (has_own_lights)
        writer.write_section(layout.own_lights, count, [&](std::size_t i) { return model.own_lights[i]; });
    writer.pad_to(layout.checksum);
    writer.write_checksum();
}

}  // namespace pointsample
