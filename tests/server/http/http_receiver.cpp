#include "server/http/http_receiver.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "programs/process.h"

namespace cellcrush::testing {
namespace {

// More of the request; false at its end.
bool read_more(int connection, std::string& text) {
  std::array<char, 65536> part{};
  const auto count = read(connection, part.data(), part.size());
  if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
  return count > 0;
}

HttpReceiver::Request read_request(int connection) {
  std::string text;
  while (text.find("\r\n\r\n") == std::string::npos && read_more(connection, text)) continue;
  HttpReceiver::Request out;
  const auto end = text.find("\r\n\r\n");
  if (end == std::string::npos) return out;
  std::istringstream head(text.substr(0, end));
  std::string method;
  head >> method >> out.path;
  std::string line;
  std::getline(head, line);
  while (std::getline(head, line)) {
    const auto colon = line.find(':');
    std::string name = line.substr(0, colon);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    std::string value = line.substr(colon + 1);
    value.erase(0, value.find_first_not_of(' '));
    if (!value.empty() && value.back() == '\r') value.pop_back();
    out.headers[name] = value;
  }
  out.body = text.substr(end + 4);
  const auto size = std::stoul(out.headers.contains("content-length") ? out.headers["content-length"] : "0");
  while (out.body.size() < size && read_more(connection, out.body)) continue;
  return out;
}

}  // namespace

HttpReceiver::HttpReceiver(Answer answer)
    : answer_(std::move(answer)), listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  if (bind(listener_, reinterpret_cast<const sockaddr*>(&address), size) != 0 || listen(listener_, 16) != 0 ||
      getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("no port to listen on");
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { serve(); });
}

HttpReceiver::~HttpReceiver() {
  shutdown(listener_, SHUT_RDWR);
  thread_.join();
  close(listener_);
}

std::string HttpReceiver::url(const std::string& path) const {
  return "http://127.0.0.1:" + std::to_string(port_) + path;
}

std::vector<HttpReceiver::Request> HttpReceiver::requests() {
  const MutexLock lock(mutex_);
  return requests_;
}

std::vector<HttpReceiver::Request> HttpReceiver::wait_for(std::size_t count) {
  wait_until([&] { return requests().size() >= count; });
  return requests();
}

void HttpReceiver::serve() {
  while (true) {
    const int connection = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) return;
    const Request request = read_request(connection);
    const int code = answer_(request);
    if (code != 0) {
      const std::string answer = "HTTP/1.1 " + std::to_string(code) + " Answer\r\nContent-Length: 0\r\n\r\n";
      if (write(connection, answer.data(), answer.size()) < 0) perror("The answer was not sent");
    }
    {
      const MutexLock lock(mutex_);
      requests_.push_back(request);
    }
    close(connection);
  }
}

}  // namespace cellcrush::testing
