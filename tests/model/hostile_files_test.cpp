// Damaged files of every format, from fixed seeds, under a ceiling of memory and of time: each is read or refused with
// one line. Each attempt runs in a child process, so that what breaks a rule is found and named.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "pointsample/points_file.h"
#include "tests/model/draco_packer.h"
#include "tests/model/gltf_packer.h"
#include "tests/model/gzip.h"
#include "tests/model/mesh_text.h"
#include "tests/model/use_file.h"
#include "tests/model/whole_files.h"
#include "tests/pointsample/models.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GRANDSTAND_SANITIZED 1
#else
#define GRANDSTAND_SANITIZED 0
#endif

namespace {

// What a loader may take for a file of a few kilobytes [bytes]; sanitizers reserve terabytes of addresses.
constexpr std::size_t memory_ceiling = std::size_t{96} << 20;
constexpr bool has_memory_ceiling = !GRANDSTAND_SANITIZED;
constexpr unsigned seconds_ceiling = GRANDSTAND_SANITIZED ? 300 : 60;  // for all attempts of one test

std::size_t address_space() {
    std::ifstream statm("/proc/self/statm");
    std::size_t pages = 0;
    statm >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Shared with the child: how far it came.
struct Progress {
    std::size_t attempt, loaded, refused;
    char broken[512];
};

// Reads the file as a program would, and throws std::logic_error for what no loader may hand on.
void use(const std::filesystem::path& path) {
    if (path.extension() == ".pts") {
        const pointsample::PointsFile file(path);
        const pointsample::PointModel model = file.unpack();
        for (const glm::vec3& position : model.positions)
            if (!std::isfinite(position.x + position.y + position.z)) throw std::logic_error("a position is no number");
        for (const motion::SurfacePoint& point : model.surface)
            if (!(point.u >= 0 && point.v >= 0 && point.u + point.v <= 1)) throw std::logic_error("u, v out of range");
        return;
    }
    tests::use_mesh_file(path);
}

class HostileFiles : public testing::Test {
protected:
    ~HostileFiles() override { munmap(progress_, sizeof *progress_); }

    // Tries bytes_of(0) to bytes_of(count - 1) as files of this name.
    void attempt(const std::string& name, std::size_t count, const std::function<std::string(std::size_t)>& bytes_of) {
        *progress_ = {};
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) work(name, count, bytes_of);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        const std::string where = name + ", attempt " + std::to_string(progress_->attempt);
        EXPECT_STREQ(progress_->broken, "") << where;
        ASSERT_FALSE(WIFSIGNALED(status))
            << where << ": signal " << WTERMSIG(status) << (WTERMSIG(status) == SIGALRM ? ", too slow" : "");
        ASSERT_EQ(WEXITSTATUS(status), 0) << where;
        ASSERT_EQ(progress_->loaded + progress_->refused, count);
    }

    // Some were read and some refused: else nothing past the first check was ever tried.
    void expect_both(std::size_t least) const {
        EXPECT_GE(progress_->loaded, least);
        EXPECT_GE(progress_->refused, least);
    }

    tests::TemporaryFolder folder_;
    Progress* progress_ = static_cast<Progress*>(
        mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));

private:
    [[noreturn]] void work(const std::string& name, std::size_t count,
                           const std::function<std::string(std::size_t)>& bytes_of) {
        if (has_memory_ceiling) {
            const std::size_t most = address_space() + memory_ceiling;
            const rlimit limit{most, most};
            setrlimit(RLIMIT_AS, &limit);
        }
        alarm(seconds_ceiling);
        for (; progress_->attempt < count; ++progress_->attempt) {
            const std::filesystem::path path = folder_.write(name, bytes_of(progress_->attempt));
            try {
                use(path);
                ++progress_->loaded;
            } catch (const std::runtime_error& error) {
                ++progress_->refused;
                check(error.what(), path.string());
            } catch (const std::exception& error) {
                note(error.what());
            }
            if (progress_->broken[0]) _exit(1);
        }
        _exit(0);
    }

    void check(const std::string& said, const std::string& path) {
        if (said.find('\n') != std::string::npos || said.find(path) != 0) note("not one line with the path: " + said);
        if (said.find("found ") == std::string::npos || said.find("expected ") == std::string::npos)
            note("not found and expected: " + said);
        if (has_memory_ceiling && said.find("more than fits into memory") != std::string::npos)
            note("over the ceiling: " + said);
    }

    void note(const std::string& text) {
        std::snprintf(progress_->broken, sizeof progress_->broken, "%s", text.c_str());
    }
};

// --- Damage

using Random = std::mt19937_64;

// Bytes: flipped, overwritten, cut out, doubled, or a number made extreme.
std::string damaged_bytes(std::string bytes, Random& random) {
    for (std::uint64_t i = 1 + random() % 4; i > 0 && !bytes.empty(); --i) {
        const std::size_t at = random() % bytes.size(),
                          size = std::min<std::size_t>(1 + random() % 9, bytes.size() - at);
        switch (random() % 5) {
            case 0:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
                break;
            case 1:
                bytes[at] = static_cast<char>(random());
                break;
            case 2:
                bytes.erase(at, size);
                break;
            case 3:
                bytes.insert(random() % bytes.size(), bytes.substr(at, size));
                break;
            default:
                for (std::size_t k = 0; k < std::min<std::size_t>(size, 4); ++k)
                    bytes[at + k] = random() % 2 ? '\xff' : '\0';
        }
    }
    return bytes;
}

std::string with_flips_from(std::size_t begin, std::string bytes, Random& random) {
    for (std::uint64_t i = 1 + random() % 4; i > 0; --i)
        bytes[begin + random() % (bytes.size() - begin)] = static_cast<char>(random());
    return bytes;
}

// Text: a word becomes a hostile one, or a line comes twice, not at all or elsewhere.
std::string damaged_text(std::string text, Random& random) {
    static const std::vector<std::string> words{"0",
                                                "-1",
                                                "1",
                                                "2147483647",
                                                "-2147483648",
                                                "4294967296",
                                                "9223372036854775807",
                                                "99999999999999999999",
                                                "nan",
                                                "-inf",
                                                "1e400",
                                                "1e39",
                                                "-1e-400",
                                                "1e38",
                                                "-3e38",
                                                "",
                                                "x",
                                                "/",
                                                "1//",
                                                "//1",
                                                "1/1/1/1",
                                                "\\",
                                                "\\\n",
                                                "list",
                                                "uchar",
                                                "double",
                                                "vertex",
                                                "face",
                                                "ascii",
                                                "f",
                                                "v",
                                                "vt",
                                                "vn",
                                                "usemtl",
                                                "mtllib",
                                                "property",
                                                "element",
                                                "end_header\n",
                                                "\t",
                                                "\r",
                                                std::string(1, '\0'),
                                                std::string(3000, '7')};
    for (std::uint64_t i = 1 + random() % 3; i > 0 && !text.empty(); --i) {
        const std::size_t at = random() % text.size();
        const std::size_t begin = text.find_last_of(" \n/", at) + 1,
                          end = std::min(text.find_first_of(" \n/", at), text.size());
        if (random() % 4 > 0) {
            text.replace(std::min(begin, end), end - std::min(begin, end), words[random() % words.size()]);
        } else {
            const std::size_t line = text.rfind('\n', at) + 1, next = std::min(text.find('\n', at), text.size());
            const std::string copy = text.substr(std::min(line, next), next - std::min(line, next)) + "\n";
            if (random() % 2) text.erase(std::min(line, next), next - std::min(line, next));
            if (random() % 2) text.insert(text.find('\n', random() % (text.size() + 1)) + 1, copy);
        }
    }
    return text;
}

// --- The formats

TEST_F(HostileFiles, ObjBytes) {
    folder_.write("looks.mtl", "newmtl a\nKd 1 0.5 0\nmap_Kd a.png\nnewmtl b\nKd 0 0 1\n");
    folder_.write("a.png", tests::make_png(2, 1, "\xff\x20\x10\x01\x02\x03"));
    const std::string whole = tests::whole_obj();
    Random random(1);
    attempt("damaged.obj", 4000, [&](std::size_t) { return damaged_bytes(whole, random); });
    expect_both(200);
}

TEST_F(HostileFiles, ObjWords) {
    folder_.write("looks.mtl", "newmtl a\nKd 1 0.5 0\n");
    const std::string whole = tests::whole_obj();
    Random random(2);
    attempt("damaged.obj", 4000, [&](std::size_t) { return damaged_text(whole, random); });
    expect_both(200);
}

TEST_F(HostileFiles, ObjTruncated) {
    const std::string whole = tests::whole_obj();
    attempt("damaged.obj", whole.size(), [&](std::size_t i) { return whole.substr(0, i); });
}

// The library and the image beside the file are damaged, the file is whole.
TEST_F(HostileFiles, ObjMaterials) {
    const std::string library = "newmtl a\nKd 1 0.5 0\nmap_Kd -s 1 1 1 a.png\nnewmtl b\nKd 0 0 1\n";
    const std::string image = tests::make_png(2, 1, "\xff\x20\x10\x01\x02\x03"), whole = tests::whole_obj();
    Random random(3);
    attempt("whole.obj", 2000, [&](std::size_t i) {
        folder_.write("looks.mtl", i % 2 ? library : damaged_text(library, random));
        folder_.write("a.png", i % 2 ? damaged_bytes(image, random) : image);
        return whole;
    });
    EXPECT_EQ(progress_->loaded, 2000u);  // a look that is lost is no reason to refuse
}

// The whole file's bytes by turns with those of its compressed data alone, so that decoders are reached.
TEST_F(HostileFiles, GltfMeshopt) {
    const std::string whole = tests::packed_glb(tests::pack_meshopt(tests::make_barrel(), "TRIANGLES"));
    const std::size_t data = whole.find("BIN");
    Random random(20);
    attempt("damaged.glb", 2000, [&](std::size_t i) {
        return i % 4 == 0 ? damaged_bytes(whole, random) : with_flips_from(data, whole, random);
    });
    expect_both(100);
}

TEST_F(HostileFiles, GltfDraco) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const std::string whole = tests::pack_draco(tests::make_barrel(), method).glb();
        const std::size_t data = whole.rfind("DRACO");
        Random random(21);
        attempt("damaged.glb", 2000, [&](std::size_t i) {
            return i % 4 == 0 ? damaged_bytes(whole, random) : with_flips_from(data, whole, random);
        });
        expect_both(30);
    }
}

TEST_F(HostileFiles, PlyBytes) {
    for (const char* format : tests::ply_formats) {
        const std::string whole = tests::ply_of(tests::make_cube(), format);
        Random random(4);
        attempt("damaged.ply", 3000, [&](std::size_t) { return damaged_bytes(whole, random); });
        expect_both(50);
    }
}

TEST_F(HostileFiles, PlyWords) {
    for (const char* format : tests::ply_formats) {
        const std::string whole = tests::ply_of(tests::make_cube(), format);
        const std::size_t end = whole.find("end_header\n") + 11;
        const bool text = std::string(format) == "ascii";
        Random random(5);
        attempt("damaged.ply", 3000, [&](std::size_t) {
            return text ? damaged_text(whole, random) : damaged_text(whole.substr(0, end), random) + whole.substr(end);
        });
        expect_both(30);
    }
}

TEST_F(HostileFiles, PlyTruncated) {
    for (const char* format : tests::ply_formats) {
        const std::string whole = tests::ply_of(tests::make_cube(), format);
        attempt("damaged.ply", whole.size() - 1, [&](std::size_t i) { return whole.substr(0, i); });
        EXPECT_EQ(progress_->loaded, 0u) << format;
    }
}

TEST_F(HostileFiles, FullPly) {
    folder_.write("a.png", tests::make_png(2, 1, "\xff\x20\x10\x01\x02\x03"));
    const std::string whole = tests::full_ply();
    Random random(21);
    attempt("damaged.ply", 4000,
            [&](std::size_t i) { return i % 2 ? damaged_text(whole, random) : damaged_bytes(whole, random); });
    expect_both(200);
}

TEST_F(HostileFiles, OffBytesAndWords) {
    const std::string whole = tests::whole_off();
    Random random(22);
    attempt("damaged.off", 4000,
            [&](std::size_t i) { return i % 2 ? damaged_text(whole, random) : damaged_bytes(whole, random); });
    expect_both(200);
    attempt("damaged.off", whole.size(), [&](std::size_t i) { return whole.substr(0, i); });
}

TEST_F(HostileFiles, Stl) {
    const std::string binary = tests::binary_stl(), text = tests::text_stl();
    Random random(23);
    attempt("damaged.stl", 4000, [&](std::size_t i) {
        return i % 3 == 0   ? damaged_bytes(binary, random)
               : i % 3 == 1 ? damaged_bytes(text, random)
                            : damaged_text(text, random);
    });
    expect_both(200);
    attempt("damaged.stl", binary.size(), [&](std::size_t i) { return binary.substr(0, i); });
    EXPECT_EQ(progress_->loaded, 0u);
}

TEST_F(HostileFiles, Packed) {
    const std::string packed = tests::gzip(tests::whole_obj());
    Random random(24);
    attempt("damaged.obj.gz", 2000, [&](std::size_t) { return damaged_bytes(packed, random); });
    EXPECT_GE(progress_->refused, 1000u);  // a checksum
    attempt("damaged.obj.gz", packed.size(), [&](std::size_t i) { return packed.substr(0, i); });
    attempt("inside.ply.gz", 500, [&](std::size_t) { return tests::gzip(damaged_text(tests::full_ply(), random)); });
    expect_both(50);
}

// What a bomb unfolds to is lines, corners, or a claim.
TEST_F(HostileFiles, Bombs) {
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    std::string faces = square, corners = square + "f";
    for (int i = 0; i < 1'000'000; ++i) faces += "f 1 2 3\n";
    for (int i = 0; i < 4'000'000; ++i) corners += " 1";
    const std::vector<std::pair<std::string, std::string>> bombs{
        {"a.obj.gz", square + std::string(80'000'000, '\n')},
        {"a.obj.gz", std::string(80'000'000, ' ')},
        {"a.obj.gz", faces},
        {"a.obj.gz", corners},
        {"a.stl.gz", std::string(80'000'000, '\0')},
        {"a.off.gz", "OFF\n2000000000 1 0\n" + std::string(80'000'000, '\n')},
        {"a.ply.gz",
         "ply\nformat binary_little_endian 1.0\nelement vertex 1000000\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n" +
             std::string(80'000'000, '\0')}};
    for (const auto& [name, bytes] : bombs) {
        const std::string packed = tests::gzip(bytes);
        attempt(name, 1, [&](std::size_t) { return packed; });
    }
}

TEST_F(HostileFiles, PointsBytes) {
    std::ostringstream out;
    pointsample::write_pts(out, tests::random_model(20, 6), "key");
    const std::string whole = out.str();
    Random random(6);
    attempt("damaged.pts", 4000, [&](std::size_t) { return damaged_bytes(whole, random); });
    EXPECT_GE(progress_->refused, 3900u);  // a checksum; a few changes change nothing
    attempt("damaged.pts", whole.size(), [&](std::size_t i) { return whole.substr(0, i); });
    EXPECT_EQ(progress_->loaded, 0u);
}

TEST_F(HostileFiles, GltfBytes) {
    const std::string whole = tests::make_everything().glb();
    Random random(7);
    attempt("damaged.glb", 4000, [&](std::size_t) { return damaged_bytes(whole, random); });
    expect_both(100);
}

TEST_F(HostileFiles, GltfWords) {
    tests::GltfBuilder builder = tests::make_everything();
    builder.glb();  // completes the document
    std::string text = builder.document.dump(1);
    Random random(8);
    attempt("damaged.glb", 4000,
            [&](std::size_t) { return tests::make_glb(damaged_text(text, random), builder.binary); });
    expect_both(100);
}

TEST_F(HostileFiles, GltfTruncated) {
    const std::string whole = tests::make_everything().glb();
    attempt("damaged.glb", whole.size(), [&](std::size_t i) { return whole.substr(0, i); });
    EXPECT_EQ(progress_->loaded, 0u);
}

// The known ways to hurt a loader, each by itself. What loads is lawful: deep chains, for one.
TEST_F(HostileFiles, GltfLies) {
    std::vector<std::string> files;
    const auto add = [&](const auto& change, bool everything = true) {
        tests::GltfBuilder builder = everything ? tests::make_everything() : tests::make_square();
        builder.glb();
        change(builder);
        files.push_back(tests::make_glb(builder.document.dump(), builder.binary));
    };
    // Cycles, of one, two and three nodes, and nodes of two parents.
    add([](auto& b) { b.document["nodes"][1]["children"] = {1}; });
    add([](auto& b) { b.document["nodes"][2]["children"] = {1}; });
    add([](auto& b) {
        b.document["nodes"][2]["children"] = {0};
        b.document["nodes"][0]["children"] = {1};
    });
    add([](auto& b) { b.document["nodes"][0]["children"] = {2}; });
    // Counts, lengths and offsets of 2^31, 2^32 and 2^63.
    for (const std::uint64_t lie : {std::uint64_t{1} << 31, std::uint64_t{1} << 32, (std::uint64_t{1} << 63) - 1}) {
        for (const char* field : {"count", "byteOffset", "bufferView"})
            for (std::size_t i = 0; i < tests::make_everything().document["accessors"].size(); ++i)
                add([&](auto& b) { b.document["accessors"][i][field] = lie; });
        for (const char* field : {"byteLength", "byteOffset", "byteStride", "buffer"})
            for (std::size_t i = 0; i < tests::make_everything().document["bufferViews"].size(); ++i)
                add([&](auto& b) { b.document["bufferViews"][i][field] = lie; });
        add([&](auto& b) { b.document["buffers"][0]["byteLength"] = lie; });
        // Without a view an accessor is zeros: a count costs the file nothing.
        add(
            [&](auto& b) {
                b.document["accessors"][0].erase("bufferView");
                b.document["accessors"][0]["count"] = lie;
            },
            false);
        add(
            [&](auto& b) {
                b.document["accessors"][1].erase("bufferView");
                b.document["accessors"][1]["count"] = lie;
            },
            false);
    }
    for (const float lie : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        for (std::size_t at = 0; at + 4 <= tests::make_everything().binary.size(); at += 4)
            add([&](auto& b) { std::memcpy(b.binary.data() + at, &lie, sizeof lie); });
    }
    add([](auto& b) { b.document["extensionsRequired"] = {"KHR_draco_mesh_compression"}; });
    add([](auto& b) { b.document["extensionsRequired"] = {"EXT_meshopt_compression"}; });
    add([](auto& b) { b.document["extensionsRequired"] = {7, nullptr}; });
    // A chain of 20,000 nodes, and as many in one ring.
    for (const bool ring : {false, true})
        add([&](auto& b) {
            constexpr int count = 20000;
            b.node(count - 1);
            for (int i = 3; i + 1 < count; ++i) b.document["nodes"][i] = {{"children", {i + 1}}};
            b.document["scenes"][0]["nodes"] = {0, 1, 3};
            if (ring) b.document["nodes"][count - 1] = {{"children", {3}}};
        });
    attempt("lie.glb", files.size(), [&](std::size_t i) { return files[i]; });
    expect_both(10);
    const std::string deep = std::string(20000, '[') + std::string(20000, ']');
    attempt("deep.gltf", 2, [&](std::size_t i) { return i == 0 ? deep : "{\"a\":" + deep + "}"; });
    EXPECT_EQ(progress_->loaded, 0u);
}

// One vertex of thousands of flat triangles that face elsewhere, and one of these a million times: nothing may look
// through all of them for each.
TEST_F(HostileFiles, GltfHub) {
    constexpr int rim = 50'000, repeats = 1'000'000;
    Random random(25);
    std::vector<float> positions{0, 0, 0};
    std::vector<std::uint16_t> corners;
    for (int i = 0; i < rim; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / rim;
        positions.insert(positions.end(), {std::cos(angle), std::sin(angle), static_cast<float>(random() % 1000)});
    }
    for (int i = 1; i < rim + repeats; ++i) {
        const auto corner = static_cast<std::uint16_t>(std::min(i, rim - 1));
        corners.insert(corners.end(), {0, corner, static_cast<std::uint16_t>(corner + 1)});
    }
    tests::GltfBuilder builder;
    builder.add_mesh({{"POSITION", builder.vec3(positions)}})["indices"] = builder.indices(corners);
    builder.node(0)["mesh"] = 0;
    const std::string whole = builder.glb();
    attempt("hub.glb", 1, [&](std::size_t) { return whole; });
    EXPECT_EQ(progress_->loaded, 1u);
}

// A header may claim no more than the file holds, whatever else is sound.
TEST_F(HostileFiles, SmallFilesCantClaimMuchMemory) {
    std::vector<std::string> files;
    for (const std::string format : tests::ply_formats)
        for (const char* vertices : {"3", "1000000", "2147483647"})
            for (const char* faces : {"1", "1000000", "4611686018427387904"})
                files.push_back("ply\nformat " + format + " 1.0\nelement vertex " + vertices +
                                "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
                                "\nproperty list uint int vertex_indices\nend_header\n" + std::string(60, '\xff'));
    attempt("claim.ply", files.size(), [&](std::size_t i) { return files[i]; });
    EXPECT_EQ(progress_->loaded, 0u);
}

}  // namespace
