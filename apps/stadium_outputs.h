// The files a run leaves. Opened before the run, so that a place that can't be written is known at once.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "apps/output.h"
#include "apps/stadium_options.h"
#include "render/image.h"
#include "sfsm/trace.h"

namespace apps {

void write_png(OutputFile& file, const render::Image& image);
void write_png(const std::string& path, const render::Image& image);

class StadiumOutputs {
public:
    // Throws what OutputFile throws, also if --png-dir is no place for pictures.
    explicit StadiumOutputs(const StadiumOptions& options);

    // If --png-every asks for this frame. The first picture makes --png-dir, so that a run that fails before leaves
    // none.
    bool wants_picture(std::int64_t frame) const;
    void write_picture(std::int64_t frame, const render::Image& image) const;

    // Whether finish() needs the last picture.
    bool wants_last_picture() const { return png_.has_value(); }

    // Puts trace, picture, summary and report in their places; a summary to read goes to stdout if no file does.
    void finish(std::span<const sfsm::TraceRow> rows, const std::map<std::string, std::string>& settings,
                std::span<const std::string> warnings, const render::Image& last_picture);

private:
    StadiumOptions options_;
    std::optional<OutputFile> trace_, png_, summary_, report_;
};

}  // namespace apps
