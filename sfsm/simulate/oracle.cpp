#include "sfsm/simulate/oracle.h"

namespace sfsm::simulate {

Decision Oracle::decide(const FrameRequest& request) {
    status_.target_ms = request.target_ms;
    status_.reason = "the oracle knows";
    if (frame_ < course_->best.size()) status_.decision = course_->best[frame_++].decision;
    return status_.decision;
}

}  // namespace sfsm::simulate
