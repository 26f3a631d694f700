// Version 2 of the solver protocol of mpm-verify in C++17: see docs/protocol.md. No dependencies.
//
// An adapter derives from mpm_verify::Solver, and its main() ends with
// `return mpm_verify::serve(about, make);`. Columns are sent as bytes; the machine must be
// little-endian. Output to std::cout is redirected to standard error. Do not use printf(), whose output
// would mix with the messages.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mpm_verify {

// A value of JSON: a number, a text, a list or members, by what was there; true is 1.
struct Json {
    bool is_number = false;
    double value = 0;
    std::string text;
    std::vector<Json> list;
    std::map<std::string, Json> members;

    const Json* find(const std::string& key) const {
        auto found = members.find(key);
        return found == members.end() ? nullptr : &found->second;
    }
    const Json& operator[](const std::string& key) const {
        if (const Json* member = find(key)) return *member;
        throw std::runtime_error("a message lacks the key " + key);
    }
    double number() const {
        if (!is_number) throw std::runtime_error("a message has something else for a number");
        return value;
    }
};

class Parser {
public:
    static Json parse(const std::string& text) {
        Parser parser(text);
        Json json = parser.value(0);
        if (parser.next() != '\0') parser.fail();
        return json;
    }

private:
    static constexpr int most_levels = 64;
    const char *at, *end;

    explicit Parser(const std::string& text) : at(text.data()), end(at + text.size()) {}

    [[noreturn]] void fail() const {
        auto excerpt = std::string(at, at + std::min<std::ptrdiff_t>(20, end - at));
        throw std::runtime_error("a message is no JSON at: " + excerpt);
    }
    char next() {  // the next sign that is no space; 0 at the end
        while (at < end && (*at == ' ' || *at == '\t' || *at == '\r' || *at == '\n')) ++at;
        return at < end ? *at : '\0';
    }
    bool take(const char* word) {
        next();
        std::ptrdiff_t length = std::ptrdiff_t(std::strlen(word));
        bool is_there = end - at >= length && std::equal(word, word + length, at);
        at += is_there ? length : 0;
        return is_there;
    }
    void expect(const char* word) {
        if (!take(word)) fail();
    }

    Json value(int level) {
        Json json;
        if (level > most_levels) fail();
        if (next() == '"') {
            json.text = string();
        } else if (take("[")) {
            if (take("]")) return json;
            do json.list.push_back(value(level + 1));
            while (take(","));
            expect("]");
        } else if (take("{")) {
            if (take("}")) return json;
            do {
                std::string key = string();
                expect(":");
                json.members[key] = value(level + 1);
            } while (take(","));
            expect("}");
        } else if (take("true")) {
            json.value = 1;
        } else if (!take("false") && !take("null")) {
            char* behind = nullptr;
            json.value = std::strtod(at, &behind);  // a std::string ends with 0
            if (behind == at) fail();
            json.is_number = true;
            at = behind;
        }
        return json;
    }

    std::string string() {
        static const std::string signs = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
        std::string text;
        for (expect("\""); at < end && *at != '"'; ++at) {
            if (*at != '\\') {
                text += *at;
            } else if (++at; at < end && signs.find(*at) != std::string::npos) {
                text += meanings[signs.find(*at)];
            } else if (end - at > 4 && *at == 'u') {
                text += '?';  // no word of the protocol has such a sign
                at += 4;
            } else {
                fail();
            }
        }
        expect("\"");
        return text;
    }
};

inline std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (unsigned char sign : text) {
        if (sign == '"' || sign == '\\') result += '\\';
        result += sign < ' ' ? ' ' : char(sign);
    }
    return result + '"';
}

// A number in JSON with all its digits.
inline std::string decimal(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

using Column = std::vector<double>;

struct Message {
    Json json;
    std::string bytes;

    // Numbers, or the place of their bytes.
    Column column(const Json& from) const {
        Column column;
        if (const Json* place = from.find("f64")) {
            double offset = place->list.at(0).number(), count = place->list.at(1).number();
            if (!(offset >= 0 && count >= 0 && offset + 8 * count <= double(bytes.size())))
                throw std::runtime_error("a column lies outside of the bytes of its message");
            const char* start = bytes.data() + std::size_t(offset);
            column.resize(std::size_t(count));
            if (count > 0) std::memcpy(column.data(), start, 8 * column.size());
            return column;
        }
        for (const Json& number : from.list) column.push_back(number.number());
        return column;
    }
};

// Messages to and from the harness.
class Channel {
public:
    Channel() : out(std::cout.rdbuf()) { std::cout.rdbuf(std::cerr.rdbuf()); }
    ~Channel() { std::cout.rdbuf(out.rdbuf()); }

    Message read() {
        std::string line;
        if (!std::getline(std::cin, line)) throw Closed();
        Message message{Parser::parse(line), ""};
        if (const Json* bytes = message.json.find("bytes")) {
            message.bytes.resize(std::size_t(bytes->number()));
            std::cin.read(&message.bytes[0], std::streamsize(message.bytes.size()));
            if (!std::cin) throw Closed();
        }
        return message;
    }
    void write(const std::string& json, const std::string& bytes = "") {
        out << json << '\n' << bytes << std::flush;
    }
    struct Closed {};

private:
    std::ostream out;
};

// The initial state of one level of refinement: `json` as in docs/protocol.md.
struct Problem {
    Message message;
    Channel& channel;

    const Json& operator[](const std::string& key) const { return message.json[key]; }
    Column column(const std::string& key) const {
        return message.column(message.json["particles"][key]);
    }
    // Force per unit of mass (m/s2) at time t (s) at the particles, one after the other.
    Column body_force(double t) const {
        Column none(column("position").size()), value;
        if (message.json["body_force"].text == "none") return none;
        if (message.json["body_force"].text == "constant") {
            value = message.column(message.json["body_force_value"]);
            for (std::size_t i = 0; i < none.size(); ++i) none[i] = value.at(i % value.size());
            return none;
        }
        return values("body_force", t);
    }
    // Values of a field at time t (s): `of` is body_force, displacement, velocity,
    // deformation_gradient, stress, initial_stress, load:INDEX or face:NAME. Fields of the initial
    // state take t = 0. Without places (reference positions in m, one place after the other), the
    // values are those at the particles, or of a quantity that is the same everywhere.
    Column values(const std::string& of, double t, const Column& places = {}) const {
        std::string request =
            "{\"type\":\"values\",\"of\":" + quoted(of) + ",\"t\":" + decimal(t);
        if (!places.empty()) {
            request += ",\"reference_position\":[";
            for (std::size_t i = 0; i < places.size(); ++i)
                request += (i > 0 ? "," : "") + decimal(places[i]);
            request += "]";
        }
        channel.write(request + "}");
        Message answer = channel.read();
        if (const Json* error = answer.json.find("error"))
            throw std::runtime_error("no values of " + of + ": " + error->text);
        return answer.column(answer.json["values"]);
    }
};

struct State {
    std::map<std::string, Column> columns;  // displacement, velocity, stress, ...
    unsigned long crossings = 0, left_domain = 0;
    double min_j = 1;
};

// A solver at one level of refinement. Errors are exceptions.
class Solver {
public:
    virtual ~Solver() = default;
    virtual void advance(long steps, double dt, double time) = 0;
    virtual State state() const = 0;
};

// The reason why a solver was not made for a problem, to be thrown.
struct Cannot : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct About {
    std::string name, version;
    int formal_order;
    std::string capabilities;  // JSON on one line
};

inline void write(Channel& channel, const State& state) {
    std::string json, bytes;
    for (const auto& [name, column] : state.columns) {
        json += (json.empty() ? "" : ",") + quoted(name) + ":{\"f64\":[" +
                std::to_string(bytes.size()) + "," + std::to_string(column.size()) + "]}";
        bytes.append(reinterpret_cast<const char*>(column.data()), 8 * column.size());
    }
    channel.write("{\"type\":\"state\",\"bytes\":" + std::to_string(bytes.size()) +
                      ",\"columns\":{" + json + "},\"crossings\":" +
                      std::to_string(state.crossings) + ",\"left_domain\":" +
                      std::to_string(state.left_domain) + ",\"min_j\":" +
                      decimal(state.min_j) + "}", bytes);
}

// Answers the harness until it sends `bye`. `make` creates a solver in the initial state.
inline int serve(const About& about,
                 const std::function<std::unique_ptr<Solver>(const Problem&)>& make) {
    Channel channel;
    std::unique_ptr<Problem> problem;
    std::unique_ptr<Solver> solver;
    auto answer = [&](Message request) {
        std::string type = request.json["type"].text;
        if (type == "hello") {
            channel.write("{\"type\":\"hello\",\"protocol\":2,\"name\":" + quoted(about.name) +
                          ",\"version\":" + quoted(about.version) + ",\"formal_order\":" +
                          std::to_string(about.formal_order) +
                          ",\"capabilities\":" + about.capabilities + "}");
        } else if (type == "problem") {
            problem.reset(new Problem{std::move(request), channel});
            solver = make(*problem);
            channel.write("{\"type\":\"ready\"}");
        } else if (type == "advance" && solver) {
            solver->advance(long(request.json["steps"].number()), request.json["dt"].number(),
                            request.json["from"].number());
            write(channel, solver->state());
        } else {
            throw std::runtime_error("there is no answer to the request " + type);
        }
    };
    try {
        for (Message request = channel.read(); request.json["type"].text != "bye";
             request = channel.read()) {
            try {
                answer(std::move(request));
            } catch (const Cannot& why) {
                channel.write("{\"type\":\"cannot\",\"reason\":" + quoted(why.what()) + "}");
            } catch (const std::exception& why) {
                channel.write("{\"type\":\"failed\",\"reason\":" + quoted(why.what()) + "}");
            }
        }
    } catch (const Channel::Closed&) {
        return 1;
    } catch (const std::exception& why) {
        std::cerr << why.what() << '\n';
        return 1;
    }
    return 0;
}

}  // namespace mpm_verify
