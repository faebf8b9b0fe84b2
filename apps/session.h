// A recording that was read; where laws are asked for with its targets set, and as a course where the loop is closed.
#pragma once

#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/early_run.h"
#include "apps/replay_options.h"
#include "apps/rerun.h"
#include "sfsm/recordings/recording.h"
#include "sfsm/simulate/course.h"
#include "sfsm/simulate/scorecard.h"
#include "sfsm/target.h"

namespace apps {

struct Session {
    sfsm::Recording recording;     // of a trace of ours the rows have the targets of this session
    sfsm::TargetSchedule targets;  // of any other recording
    bool has_targets = false;      // its own, or asked for
    int delay = 0;                 // [frames]
    sfsm::Drawing drawing = sfsm::Drawing::opengl;
    std::vector<sfsm::simulate::Contestant> laws;  // asked for
    std::optional<sfsm::simulate::Course> course;  // closed loop
    std::unique_ptr<EarlyRun> early;               // open loop: of the first law, while the recording was read
};

// The recording at `path`. Says on stderr what the reader had to say, and adds to its notes which of several streams
// was taken. Throws what the readers throw.
Session open_session(const ReplayOptions& options, const std::string& path);

// A trace of ours, or throws std::runtime_error saying what was found.
sfsm::Trace read_own_trace(const std::string& path);

// The law that a trace says has decided, or throws std::runtime_error that names the trace: it says none that there is,
// or one that needs a course where there is none.
sfsm::simulate::Contestant law_of(const sfsm::Trace& trace, bool may_need_course);

// What is made of a file's rows, by functions that don't know whose they are: their errors begin with its path.
template <class Make>
auto made_of(const std::string& path, const Make& make) {
    try {
        return make();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(path + ": " + error.what());
    } catch (const std::invalid_argument& error) {
        throw std::runtime_error(path + ": " + error.what());
    }
}

// The recording's rows with this session's targets; of other tools' recordings made as they are asked for. The session
// must outlive them and stay where it is.
sfsm::RunRows rows_of(const Session& session);

// The recorded run as it was, beside which the laws' are shown, and a law's; a law's of session.early once.
Rerun recorded_run(const Session& session);
Rerun rerun(const Session& session, const sfsm::simulate::Contestant& law);

// How laws are fed, in the order shown; nothing where none is asked for.
std::vector<std::pair<std::string, std::string>> loop_facts(const Session& session);

// What is said of the session as JSON, in its order.
std::vector<std::pair<std::string, std::string>> facts_of(const Session& session, const std::string& path);

// The run as a trace, with the forecasts that the law was given.
void write_trace(std::ostream& out, const Session& session, const Rerun& rerun);

}  // namespace apps
