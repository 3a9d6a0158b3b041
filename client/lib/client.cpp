#include "client/lib/client.h"

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <deque>
#include <map>
#include <thread>

#include "client/lib/address.h"
#include "proto/framing.h"

namespace posed::client {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using TimePoint = std::chrono::steady_clock::time_point;

constexpr std::size_t kMaxKept = 4096;                  // frames that nobody has asked for yet
constexpr std::size_t kMaxLine = std::size_t{1} << 30;  // we trust our daemon: a reply may be longer than a request

TimePoint from_now(Client::Duration duration) {
  return std::chrono::steady_clock::now() + duration;
}

}  // namespace

struct Client::Impl {
  // Runs until `done` or `until`; with a last look when the time is already over.
  bool wait(const bool& done, TimePoint until) {
    io.restart();
    while (!done && !(heeds_wake && woken) && io.run_one_until(until) > 0) {
    }
    if (!done) io.poll();
    return done;
  }

  Error lose(std::string why) {
    lost_why = std::move(why);
    error_code ignored;
    socket.close(ignored);
    // What was under way ends now: its handlers look at members that the next connection uses.
    io.restart();
    io.poll();
    reading = false;
    return gone();
  }
  Error gone() const {
    return {"connection_lost", "the connection to " + address.text() + " is lost: " + lost_why, "", "connect again"};
  }
  Error late() const { return {"timeout", "the daemon at " + address.text() + " did not answer in time", "", ""}; }

  Status connect(TimePoint until);
  Status open(TimePoint until);
  Status handshake(TimePoint until);
  Status introduce(TimePoint until);
  Status restore();
  template <class Buffer, class Handler>
  void write(const Buffer& bytes, Handler handler) {
    tls ? asio::async_write(*tls, bytes, std::move(handler)) : asio::async_write(socket, bytes, std::move(handler));
  }
  template <class Handler>
  void read(Handler handler) {
    tls ? tls->async_read_some(asio::buffer(buffer), std::move(handler))
        : socket.async_read_some(asio::buffer(buffer), std::move(handler));
  }
  Result<std::string> exchange(std::int64_t id, std::string line, TimePoint until);
  Status send(std::string line, TimePoint until);
  Result<proto::Incoming> receive(TimePoint until);
  Result<std::string> await_reply(std::int64_t id, TimePoint until);
  void keep(proto::Incoming frame);

  bool heeds_wake = false, woken = false;
  Address address;
  Identity identity;
  Duration timeout{5000}, patience{0};
  std::uint64_t reconnected = 0;
  asio::io_context io{1};
  tcp::socket socket{io};
  std::optional<asio::ssl::context> tls_context;
  std::optional<asio::ssl::stream<tcp::socket&>> tls;
  std::map<proto::Stream, proto::StreamSubscribe> subscriptions;
  std::string lost_why;  // empty: connected
  proto::LineSplitter splitter{kMaxLine};
  std::array<char, 64 << 10> buffer;
  std::size_t received = 0;
  bool reading = false, read_done = false;
  error_code read_error;
  std::deque<proto::Incoming> frames;
  std::array<std::uint64_t, proto::kStreams> lost{};
  std::array<int, proto::kStreams> credit{};
  std::int64_t next_id = 1;
  std::function<void(std::uint64_t, std::uint64_t)> progress;
};

Status Client::Impl::connect(TimePoint until) {
  if (Status opened = open(until); !opened) return opened;
  if (address.tls) {
    if (Status shaken = handshake(until); !shaken) return shaken;
  }
  return introduce(until);
}

Status Client::Impl::handshake(TimePoint until) {
  const auto failed = [&](const std::string& why) {
    return Error{"cannot_connect", "no TLS with " + address.text() + ": " + why, "",
                 "is its certificate known here? name its authority's file"};
  };
  error_code error;
  tls_context.emplace(asio::ssl::context::tls_client);
  tls_context->set_verify_mode(asio::ssl::verify_peer);
  if (identity.authority.empty())
    tls_context->set_default_verify_paths(error);
  else
    tls_context->load_verify_file(identity.authority, error);
  if (error) return failed(error.message());
  tls.emplace(socket, *tls_context);
  SSL_set_tlsext_host_name(tls->native_handle(), address.host.c_str());
  tls->set_verify_callback(asio::ssl::host_name_verification(address.host));
  bool done = false;
  tls->async_handshake(asio::ssl::stream_base::client, [&](error_code e) {
    error = e;
    done = true;
  });
  if (!wait(done, until)) {
    error_code ignored;
    socket.close(ignored);
    io.restart();
    io.run();
    return failed("it took too long");
  }
  if (error) return failed(error.message());
  return Ok{};
}

// Says who we are, where that is asked for, and subscribes to what we followed.
Status Client::Impl::introduce(TimePoint until) {
  if (!identity.token.empty() || !identity.user.empty() || !identity.resume.empty() || !identity.program.empty()) {
    const std::size_t space = identity.program.find(' ');
    proto::SessionHello hello;
    hello.client.name = identity.program.substr(0, space);
    if (space != std::string::npos) hello.client.version = identity.program.substr(space + 1);
    hello.token = identity.token;
    hello.user = identity.user;
    hello.resume = identity.resume;
    const std::int64_t id = next_id++;
    const auto done = exchange(id, proto::encode_request(id, hello), until);
    if (!done) return done.error();
    const auto result = proto::decode_message<proto::HelloResult>(*done);
    if (!result) return result.error();
    identity.resume = result->resume;
  }
  std::vector<proto::Params> requests;
  for (const auto& [stream, subscription] : subscriptions) requests.emplace_back(subscription);
  for (const proto::Params& request : requests) {
    const std::int64_t id = next_id++;
    const auto done = exchange(id, proto::encode_request(id, request), until);
    if (!done) return done.error();
  }
  return Ok{};
}

// Connected, if need be again.
Status Client::Impl::restore() {
  if (lost_why.empty()) return Ok{};
  if (patience.count() == 0) return gone();
  const TimePoint until = from_now(patience);
  for (Duration pause{20};; pause = std::min(2 * pause, Duration(2000))) {
    lost_why.clear();
    tls.reset();
    socket = tcp::socket(io);
    splitter = proto::LineSplitter(kMaxLine);
    reading = read_done = false;
    const Status connected = connect(std::min(until, from_now(timeout)));
    if (connected) return ++reconnected, connected;
    lose(connected.error().message);
    const std::string& code = connected.error().code;
    const bool refused = code != "cannot_connect" && code != "connection_lost" && code != "timeout";
    if (refused || std::chrono::steady_clock::now() + pause > until) return connected;
    std::this_thread::sleep_for(pause);
  }
}

Status Client::Impl::open(TimePoint until) {
  const auto failed = [&](const error_code& error) {
    if (error == asio::error::connection_refused) {
      return Error{"cannot_connect", "nothing listens at " + address.text(), "", "start the daemon with ./deploy/run"};
    }
    return Error{"cannot_connect", "cannot connect to " + address.text() + ": " + error.message(), "",
                 "is the address right?"};
  };
  error_code error;
  tcp::resolver resolver(io);
  const auto endpoints = resolver.resolve(address.host, address.port, error);
  if (error) return failed(error);
  bool done = false;
  asio::async_connect(socket, endpoints, [&](error_code e, const tcp::endpoint&) {
    error = e;
    done = true;
  });
  if (!wait(done, until)) {
    error_code ignored;
    socket.close(ignored);
    io.restart();
    io.run();
    return failed(asio::error::timed_out);
  }
  if (error) return failed(error);
  socket.set_option(tcp::no_delay(true), error);
  return Ok{};
}

Status Client::Impl::send(std::string line, TimePoint until) {
  if (!lost_why.empty()) return gone();
  line.push_back('\n');
  // Shared with the handler: it may outlive this call if the time runs out.
  auto text = std::make_shared<const std::string>(std::move(line));
  auto done = std::make_shared<std::pair<bool, error_code>>();
  write(asio::buffer(*text), [text, done](error_code e, std::size_t) { *done = {true, e}; });
  // Half a line would spoil all that follow.
  if (!wait(done->first, until)) return lose("it takes no more requests");
  if (done->second) return lose(done->second.message());
  return Ok{};
}

Result<proto::Incoming> Client::Impl::receive(TimePoint until) {
  for (;;) {
    if (const auto line = splitter.next()) {
      auto incoming = proto::decode_incoming(*line);
      if (!incoming) lose(incoming.error().message);
      return incoming;
    }
    if (!lost_why.empty()) return gone();
    if (!reading) {
      reading = true;
      read_done = false;
      read([this](error_code e, std::size_t size) {
        read_error = e;
        received = size;
        read_done = true;
      });
    }
    if (!wait(read_done, until)) {
      if (heeds_wake && std::exchange(woken, false)) return Error{"woken", "somebody has called wake()", "", ""};
      return late();
    }
    reading = false;
    if (read_error) return lose(read_error == asio::error::eof ? "the daemon has closed it" : read_error.message());
    if (!splitter.push(std::string_view(buffer.data(), received))) return lose("a line is too long");
  }
}

void Client::Impl::keep(proto::Incoming frame) {
  if (frame.method == "solve.progress" && progress) progress(frame.done, frame.of);
  if (!frame.stream) return;
  const auto stream = static_cast<std::size_t>(*frame.stream);
  if (frame.method == "stream.lost") lost[stream] += frame.dropped;
  if (frame.method != "stream.frame") return;
  if (frames.size() == kMaxKept) {
    ++lost[static_cast<std::size_t>(*frames.front().stream)];
    frames.pop_front();
  }
  frames.push_back(std::move(frame));
}

Result<std::string> Client::Impl::await_reply(std::int64_t id, TimePoint until) {
  for (;;) {
    auto incoming = receive(until);
    if (!incoming) return incoming.error();
    if (incoming->id == id) {
      if (incoming->error) return *incoming->error;
      return std::move(incoming->result);
    }
    // An error without an id is said of the whole connection, before it is closed. A reply to another id is one that
    // came too late for its call.
    if (!incoming->id && incoming->error) return *incoming->error;
    if (!incoming->id) keep(std::move(*incoming));
  }
}

Result<std::string> Client::Impl::exchange(std::int64_t id, std::string line, TimePoint until) {
  const Status sent = send(std::move(line), until);
  if (!sent) return sent.error();
  return await_reply(id, until);
}

Client::Client(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;

Result<Client> Client::connect(std::string_view address, Duration timeout, Identity identity) {
  auto parsed = parse_address(address);
  if (!parsed) return parsed.error();
  auto impl = std::make_unique<Impl>();
  impl->address = std::move(*parsed);
  impl->timeout = timeout;
  impl->identity = std::move(identity);
  const Status status = impl->connect(from_now(timeout));
  if (!status) return status.error();
  return Client(std::move(impl));
}

void Client::set_timeout(Duration timeout) {
  impl_->timeout = timeout;
}

void Client::keep_connected(Duration patience) {
  impl_->patience = patience;
}

std::uint64_t Client::reconnected() const {
  return impl_->reconnected;
}

void Client::on_progress(std::function<void(std::uint64_t done, std::uint64_t of)> told) {
  impl_->progress = std::move(told);
}

Result<std::string> Client::call(std::string_view method, std::string_view params_json) {
  const std::int64_t id = impl_->next_id++;
  auto line = proto::encode_call(id, method, params_json);
  if (!line) return line.error();
  if (const Status there = impl_->restore(); !there) return there.error();
  return impl_->exchange(id, std::move(*line), from_now(impl_->timeout));
}

Result<std::string> Client::request(const proto::Params& params) {
  if (const Status there = impl_->restore(); !there) return there.error();
  const std::int64_t id = impl_->next_id++;
  return impl_->exchange(id, proto::encode_request(id, params), from_now(impl_->timeout));
}

Status Client::subscribe(const proto::StreamSubscribe& subscription) {
  const auto result = request(subscription);
  if (!result) return result.error();
  // Frames that came before the reply are the old subscription's.
  std::erase_if(impl_->frames, [&](const proto::Incoming& frame) { return frame.stream == subscription.stream; });
  impl_->credit[static_cast<std::size_t>(subscription.stream)] = subscription.credit;
  impl_->subscriptions[subscription.stream] = subscription;
  return Ok{};
}

Status Client::unsubscribe(proto::Stream stream) {
  impl_->subscriptions.erase(stream);
  const auto result = request(proto::StreamUnsubscribe{stream});
  if (!result) return result.error();
  std::erase_if(impl_->frames, [&](const proto::Incoming& frame) { return frame.stream == stream; });
  return Ok{};
}

void Client::wake() {
  asio::post(impl_->io, [impl = impl_.get()] { impl->woken = true; });
}

Result<proto::Incoming> Client::next(Duration timeout) {
  const TimePoint until = from_now(timeout);
  while (impl_->frames.empty()) {
    impl_->heeds_wake = true;
    auto incoming = impl_->receive(until);
    impl_->heeds_wake = false;
    if (!incoming && !impl_->lost_why.empty() && impl_->patience.count() > 0) {
      if (const Status there = impl_->restore(); !there) return there.error();
      continue;
    }
    if (!incoming) return incoming.error();
    if (!incoming->id && incoming->error) return *incoming->error;
    if (!incoming->id) impl_->keep(std::move(*incoming));
  }
  proto::Incoming frame = std::move(impl_->frames.front());
  impl_->frames.pop_front();
  if (impl_->credit[static_cast<std::size_t>(*frame.stream)] > 0) {
    const Status sent =
        impl_->send(proto::encode_notification(proto::StreamAck{*frame.stream, frame.seq}), from_now(impl_->timeout));
    // The frame is good all the same; that the connection is lost is the next call's affair.
    if (!sent && impl_->patience.count() == 0) return sent.error();
  }
  return frame;
}

std::uint64_t Client::lost(proto::Stream stream) const {
  return impl_->lost[static_cast<std::size_t>(stream)];
}

}  // namespace posed::client
