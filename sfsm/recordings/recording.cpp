#include "sfsm/recordings/recording.h"

namespace sfsm {

Recording read_recording(std::istream& in, const std::string& name, const RecordingOptions&) {
    Recording recording;
    recording.format = "trace";
    recording.trace = read_trace(in, name);
    return recording;
}

}  // namespace sfsm
