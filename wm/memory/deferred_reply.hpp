#pragma once

#include "castor/base/caf.hpp"

#include <memory>
#include <utility>

namespace castor {

/// An answer that somebody waits for. If it is never given, because the working memory ends before,
/// they get an error.
template <class Reply>
class DeferredReply {
public:
  explicit DeferredReply(caf::typed_response_promise<Reply> promise)
    : promise_(std::move(promise)) {}
  DeferredReply(const DeferredReply&) = delete;
  DeferredReply& operator=(const DeferredReply&) = delete;
  ~DeferredReply() {
    if (wanted_ && promise_.pending())
      promise_.deliver(caf::make_error(caf::sec::request_receiver_down));
  }

  void deliver(Reply x) { promise_.deliver(std::move(x)); }

  /// Nobody wants it any more.
  void abandon() { wanted_ = false; }

  const caf::typed_response_promise<Reply>& promise() const { return promise_; }

private:
  caf::typed_response_promise<Reply> promise_;
  bool wanted_ = true;
};

template <class Reply>
using DeferredReplyPtr = std::shared_ptr<DeferredReply<Reply>>;

/// The answer to the current message is given later.
template <class Reply, class Self>
DeferredReplyPtr<Reply> defer(Self self) {
  return std::make_shared<DeferredReply<Reply>>(self->template make_response_promise<Reply>());
}

} // namespace castor
