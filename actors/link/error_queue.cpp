#include "castor/actors/link/error_queue.hpp"

#include <openssl/err.h>

namespace castor {

namespace {

int reason_of(int library) {
  auto error = ERR_peek_last_error();
  return ERR_GET_LIB(error) == library ? ERR_GET_REASON(error) : 0;
}

} // namespace

ErrorQueue::ErrorQueue() {
  ERR_clear_error();
}

ErrorQueue::~ErrorQueue() {
  ERR_clear_error();
}

int ErrorQueue::ssl_reason() const {
  return reason_of(ERR_LIB_SSL);
}

int ErrorQueue::pem_reason() const {
  return reason_of(ERR_LIB_PEM);
}

std::string ErrorQueue::text() const {
  auto* text = ERR_reason_error_string(ERR_peek_last_error());
  return text ? text : "OpenSSL gives no reason";
}

} // namespace castor
