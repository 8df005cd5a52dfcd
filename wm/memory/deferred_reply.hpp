#pragma once

#include "castor/base/caf.hpp"

#include <memory>
#include <utility>

namespace castor {

/// A reply that is sent later. If it is destroyed before, because the working memory ends, the
/// requester gets an error.
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

  /// No reply is wanted any more: destruction sends no error.
  void abandon() { wanted_ = false; }

  const caf::typed_response_promise<Reply>& promise() const { return promise_; }

private:
  caf::typed_response_promise<Reply> promise_;
  bool wanted_ = true;
};

template <class Reply>
using DeferredReplyPtr = std::shared_ptr<DeferredReply<Reply>>;

/// Defers the reply to the current message.
template <class Reply, class Self>
DeferredReplyPtr<Reply> defer(Self self) {
  return std::make_shared<DeferredReply<Reply>>(self->template make_response_promise<Reply>());
}

} // namespace castor
