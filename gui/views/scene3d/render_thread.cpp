#include "gui/views/scene3d/render_thread.h"

#include <QElapsedTimer>
#include <QMetaObject>

#include "common/core/scheduling.h"

namespace kiln::gui {

RenderThread::RenderThread(SceneRenderer::Config config, RobotShape shape, QObject* parent)
    : QObject(parent),
      thread_([this, config, robot = std::move(shape)](const std::stop_token& stop) {
        run(stop, config, robot);
      }) {}

RenderThread::~RenderThread() {
  thread_.request_stop();
  thread_.join();
}

void RenderThread::request(SceneJob job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
  }
  wake_.notify_one();
}

void RenderThread::run(const std::stop_token& stop, SceneRenderer::Config config,
                       const RobotShape& shape) {
  runAfterOthers();  // a picture may be late, a key may not
  SceneRenderer renderer(config, shape);
  while (!stop.stop_requested()) {
    std::optional<SceneJob> job;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return job_.has_value(); })) return;
      job.swap(job_);
    }
    QElapsedTimer timer;
    timer.start();
    SceneFrame frame;
    frame.image = renderer.render(job->snapshot, job->camera, job->colors, job->pixels.width(),
                                  job->pixels.height());
    frame.camera = job->camera;
    frame.render_ms = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
    QMetaObject::invokeMethod(
        this, [this, frame = std::move(frame)] { emit rendered(frame); }, Qt::QueuedConnection);
  }
}

}  // namespace kiln::gui
