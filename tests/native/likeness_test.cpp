// People drawn by the processor as triangles look like those that OpenGL draws: sample by sample, so OpenGL draws twice
// as wide and high.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>

#include "model/io/mesh_file.h"
#include "scene/cast.h"
#include "scene/person.h"
#include "tests/native/layers.h"
#include "tests/native/mesh_people.h"
#include "tests/reference/harlequin.h"
#include "tests/reference/studio.h"
#include "tests/render/gl_test.h"

namespace {

using Likeness = tests::GlTest;

// Linear.
struct Picture {
    int width, height;
    std::vector<glm::vec3> pixels;

    const glm::vec3& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

glm::vec3 linear(const std::uint8_t* srgb) {
    const glm::vec3 c = glm::vec3(srgb[0], srgb[1], srgb[2]) / 255.0f;
    return c * c;
}

// Each pixel the mean of 2x2.
Picture halved(const render::Image& image) {
    Picture out{image.width / 2, image.height / 2, {}};
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            glm::vec3 sum(0);
            for (int i = 0; i < 4; ++i)
                sum += linear(&image.pixels[3 * (std::size_t(2 * y + i / 2) * image.width + 2 * x + i % 2)]);
            out.pixels.push_back(sum / 4.0f);
        }
    }
    return out;
}

Picture over(const tests::Layer& layer, const Picture& behind) {
    Picture out = behind;
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        const auto& c = layer.rgba[i];
        out.pixels[i] = glm::vec3(c[0], c[1], c[2]) / 32767.0f + (1 - c[3] / 32767.0f) * behind.pixels[i];
    }
    return out;
}

// For whoever wants to look: GRANDSTAND_PICTURES names a folder.
void write(const std::string& name, const std::vector<const Picture*>& beside) {
    const char* folder = std::getenv("GRANDSTAND_PICTURES");
    if (folder == nullptr) return;
    render::Image image{0, beside.front()->height, {}};
    for (const Picture* picture : beside) image.width += picture->width;
    for (int y = 0; y < image.height; ++y)
        for (const Picture* picture : beside)
            for (int x = 0; x < picture->width; ++x)
                for (int c = 0; c < 3; ++c)
                    image.pixels.push_back(
                        static_cast<std::uint8_t>(std::lround(255 * std::sqrt(std::min(picture->at(x, y)[c], 1.0f)))));
    const auto bytes = render::encode_png(image);
    std::ofstream(std::filesystem::path(folder) / (name + ".png"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

struct Difference {
    int inner = 0;       // pixels that are covered wholly
    double far_off = 0;  // the share of them that is off by more than `close`
    double mean = 0;     // [of 255] how far they are off
    double outline = 0;  // [of 255] the same of pixels at the outline
};
constexpr double close = 2;  // [of 255]

double off(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 d = glm::abs(glm::sqrt(a) - glm::sqrt(b)) * 255.0f;
    return std::max({d.x, d.y, d.z});
}

Difference compare(const Picture& native, const Picture& gl, const tests::Layer& layer) {
    Difference d;
    int outline = 0;
    for (int y = 0; y < native.height; ++y) {
        for (int x = 0; x < native.width; ++x) {
            const std::uint16_t cover = layer.rgba[layer.at(x, y)][3];
            if (cover == 0) continue;
            const double here = off(native.at(x, y), gl.at(x, y));
            if (cover < 32767) {
                d.outline += here;
                ++outline;
                continue;
            }
            ++d.inner;
            d.mean += here;
            d.far_off += here > close;
        }
    }
    d.far_off /= std::max(d.inner, 1);
    d.mean /= std::max(d.inner, 1);
    d.outline /= std::max(outline, 1);
    return d;
}

struct Shot {
    std::string name;
    scene::CameraPose pose;
    int width, height;
};

// With their middle at the origin.
Difference shoot(const reference::Model& model, const std::string& name, const Shot& shot) {
    const double scale = 1.75 / model.figure.height();
    reference::Person person;
    person.figure = &model.figure;
    person.origin = {0, -scale * model.figure.middle(), 0};
    person.yaw = 0.7;
    person.scale = scale;
    person.palette = reference::motley;
    const reference::Model* models[] = {&model};
    const std::vector<figures::Figure> figures{model.product()};

    const render::View view = render::make_view(shot.pose, shot.width, shot.height);
    const render::View fine = render::make_view(shot.pose, 2 * shot.width, 2 * shot.height);
    const scene::StaticMesh nothing{{{}, {}, {}}, {0, 0, 0}, {}};
    render::gl::Renderer renderer(nothing, {}, {}, figures, fine.width, fine.height);
    render::Frame frame;
    frame.view = fine;
    renderer.draw(frame);
    const Picture behind = halved(renderer.read_image());
    frame = reference::frame_of(std::span(&person, 1), models, fine, 0);
    renderer.draw(frame);
    const Picture gl = halved(renderer.read_image());

    render::native::TrianglePeople people(figures, {});
    const tests::MeshPeople whom(tests::mesh_people(frame));
    const tests::Layer layer = tests::draw(people, view, whom.pointers, tests::backdrop(shot.width, shot.height));
    const Picture native = over(layer, behind);
    write(name + "_" + shot.name, {&gl, &native});
    return compare(native, gl, layer);
}

// From so far away that whoever is 1.75 m tall takes so many pixels.
Shot tall(int pixels) {
    const double fov = 0.9;
    const int height = pixels * 5 / 4;
    const double distance = 1.75 * height / pixels / (2 * std::tan(fov / 2));
    scene::CameraPose pose;
    pose.position = {0.3 * distance, 0.3 * distance, 0.9 * distance};
    pose.target = {0, 0, 0};
    pose.fov_y = fov;
    return {std::to_string(pixels), pose, height, height};
}

// With the camera inside of them.
Shot inside() {
    scene::CameraPose pose;
    pose.position = {0.05, 0.3, 0.25};
    pose.target = {0, 0.2, 0};
    pose.fov_y = 1.8;
    return {"inside", pose, 300, 240};
}

void expect_alike(const std::string& name, model::Character character) {
    const scene::Casting casting = scene::cast(character);
    scene::add_stills(character, casting);
    const reference::Model model(std::move(character), casting.clips, 64);
    for (const Shot& shot : {tall(400), tall(150), tall(60), tall(1500), inside()}) {
        const Difference d = shoot(model, name, shot);
        const std::string text = name + " " + shot.name + ": " + std::to_string(d.inner) + " pixels, a share of " +
                                 std::to_string(d.far_off) + " off by more than 2, mean " + std::to_string(d.mean) +
                                 ", at the outline " + std::to_string(d.outline);
        std::printf("%s\n", text.c_str());
        EXPECT_GT(d.inner, 0) << text;
        // Where parts overlap, edges of a sixteenth of a sample decide; and the mipmap is the driver's own choice.
        EXPECT_LT(d.far_off, 0.1) << text;
        EXPECT_LT(d.mean, 1.5) << text;
        EXPECT_LT(d.outline, 3.0) << text;
    }
}

void expect_asset_alike(const std::string& name) {
    const std::filesystem::path file = std::filesystem::path(GRANDSTAND_SHARED) / "assets" / name / (name + ".glb");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "NO " << file << ", NOTHING IS TESTED HERE";
    expect_alike(name, model::load_mesh(file));
}

TEST_F(Likeness, OfTheBuiltInPerson) {
    expect_alike("person", scene::make_person());
}

TEST_F(Likeness, OfAHarlequin) {
    expect_alike("harlequin", reference::make_harlequin(false));
}

TEST_F(Likeness, OfAnOpenHarlequin) {
    expect_alike("open", reference::make_harlequin(true));
}

TEST_F(Likeness, OfAMaskedHarlequin) {
    expect_alike("masked", reference::make_masked_harlequin());
}

TEST_F(Likeness, OfATexturedMan) {
    expect_asset_alike("CesiumMan");
}

TEST_F(Likeness, OfATexturedFox) {
    expect_asset_alike("Fox");
}

}  // namespace
