#include "tests/bench/front/references.h"

#include <stb_image.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "apps/interrupt.h"
#include "apps/output.h"
#include "tests/bench/fidelity.h"
#include "tests/bench/front/digest.h"
#include "tests/bench/front/files.h"

namespace bench::front {

namespace {

// To be raised when how references are made changes.
constexpr double version = 1;

std::string name_of(Venue& venue, const scene::CameraPose& pose, std::int64_t tick, bool everybody) {
    Digest digest;
    digest.add(version);
    digest.add(venue.key());
    for (const double number :
         {pose.position.x, pose.position.y, pose.position.z, pose.target.x, pose.target.y, pose.target.z, pose.fov_y,
          static_cast<double>(tick), static_cast<double>(venue.size().width), static_cast<double>(venue.size().height),
          static_cast<double>(reference_factor), static_cast<double>(everybody)})
        digest.add(number);
    return "reference-" + digest.text() + ".png";
}

std::string digest_of(std::string_view bytes) {
    Digest digest;
    digest.add(bytes);
    return digest.text();
}

// Empty if there is no such picture, or it is damaged. A PNG's reader needn't notice that a bit has changed: the file
// ends with the digest of what comes before.
render::Image kept(const std::filesystem::path& path, Size size) {
    const std::string file = contents_of(path).value_or("");
    const std::string_view png(file.data(), file.size() - std::min(Digest::length, file.size()));
    if (file.substr(png.size()) != digest_of(png)) return {};
    render::Image image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> data(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()), static_cast<int>(png.size()), &image.width,
                              &image.height, &channels, 3),
        stbi_image_free);
    if (!data || image.width != size.width || image.height != size.height) return {};
    image.pixels.assign(data.get(), data.get() + std::size_t{3} * image.width * image.height);
    return image;
}

void keep(const std::filesystem::path& path, const render::Image& image) {
    make_folder(path.parent_path());
    apps::OutputFile file(path);
    const std::vector<std::uint8_t> bytes = render::encode_png(image);
    const std::string_view png(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    file.stream() << png << digest_of(png);
    file.commit();
}

}  // namespace

std::vector<std::uint8_t> Reference::crowd() const {
    std::vector<std::uint8_t> mask;
    for (std::size_t i = 0; i + 2 < now.pixels.size(); i += 3)
        mask.push_back(now.pixels[i] != nobody.pixels[i] || now.pixels[i + 1] != nobody.pixels[i + 1] ||
                       now.pixels[i + 2] != nobody.pixels[i + 2]);
    return mask;
}

Reference References::of(Venue& venue, const Shot& shot) {
    return {picture(venue, shot.before, shot.tick - 1, Who::everybody),
            picture(venue, shot.now, shot.tick, Who::everybody), picture(venue, shot.now, shot.tick, Who::nobody)};
}

render::Image References::picture(Venue& venue, const scene::CameraPose& pose, std::int64_t tick, Who who) {
    const Size size = venue.size();
    const std::filesystem::path path = folder_ / name_of(venue, pose, tick, who == Who::everybody);
    if (render::Image image = kept(path, size); !image.pixels.empty()) return image;
    apps::throw_if_interrupted();
    Shooter& shooter = who == Who::everybody ? venue.shooter(sfsm::Drawing::native) : venue.nobody();
    const render::View view = render::make_view(pose, reference_factor * size.width, reference_factor * size.height);
    const render::Image image = box_filtered(shooter.picture(view, triangles(), tick), reference_factor);
    venue.renderer(sfsm::Drawing::native).resize(size.width, size.height);
    keep(path, image);
    ++drawn_;
    return image;
}

}  // namespace bench::front
