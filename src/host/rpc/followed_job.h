// followed_job.h — The second half of Analyze and Render: a job's progress to the client, until it has its
// answer.
#pragma once

#include <functional>
#include <memory>

#include "rpc/call.h"
#include "scene_analyzer/v1/service.pb.h"
#include "service/job.h"

namespace scene_analyzer::rpc {

// Submits the order and waits. `send` is given the progress at most ten times a second. Throws
// service::Refusal: the job's, and when the client no longer waits, which ends the job; so does whatever else
// is thrown meanwhile.
service::Answer follow_job(Call& call, service::Executor& executor, service::Order order,
                           const std::function<void(const v1::Progress&)>& send);

}  // namespace scene_analyzer::rpc
