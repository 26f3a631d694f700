// An explicit MPM in one or two dimensions, in C++17, as a solver under test.
//
//     g++ -O2 -std=c++17 -o mpm mpm.cpp
//     mpm-verify run SUITE --solver './mpm --basis quadratic_bspline --scheme usl'
//
// Sulsky, Chen & Schreyer (1994) with FLIP and a lumped mass matrix; B-splines at walls as in
// Steffen, Kirby & Berzins (2008).

#include <array>

#include "mpm_verify.hpp"

using mpm_verify::Column, mpm_verify::Json, mpm_verify::Problem, mpm_verify::State;

template <int D> using Vector = std::array<double, D>;
template <int D> using Matrix = std::array<Vector<D>, D>;

double det(const Matrix<1>& a) { return a[0][0]; }
double det(const Matrix<2>& a) { return a[0][0] * a[1][1] - a[0][1] * a[1][0]; }

// A column of numbers as one of vectors or matrices, and back.
template <class T> std::vector<T> grouped(const Column& column) {
    std::vector<T> result(column.size() * sizeof(double) / sizeof(T));
    if (!result.empty()) std::memcpy(result.data(), column.data(), result.size() * sizeof(T));
    return result;
}
template <class T> Column flat(const std::vector<T>& rows) {
    Column result(rows.size() * sizeof(T) / sizeof(double));
    if (!result.empty()) std::memcpy(result.data(), rows.data(), rows.size() * sizeof(T));
    return result;
}

constexpr int most_functions = 4;

// Values and slopes (per cell) of the functions that do not vanish at a place along an axis.
struct Functions {
    std::array<double, most_functions> value{}, slope{};

    // At s (in cells), by the recursion of Cox and de Boor. Knots are repeated at walls.
    Functions(int degree, double s, int cell, int cells, bool periodic) {
        std::array<double, 2 * most_functions> knot{};
        for (int k = 0; k < 2 * degree; ++k) {
            double uniform = cell + 1 + k - degree;
            knot[k] = periodic ? uniform : std::min(std::max(uniform, 0.0), double(cells));
        }
        value[0] = 1;
        for (int p = 1; p <= degree; ++p) {
            auto lower = value;
            double saved = 0;
            for (int r = 0; r < p; ++r) {
                double left = knot[degree + r - p], right = knot[degree + r];
                double share = lower[r] / (right - left);
                value[r] = saved + (right - s) * share;
                saved = (s - left) * share;
            }
            value[p] = saved;
            if (p < degree) continue;
            for (int r = 0; r < degree; ++r) {
                double term = degree * lower[r] / (knot[degree + r] - knot[r]);
                slope[r] -= term;
                slope[r + 1] += term;
            }
        }
    }
};

struct Options {
    int degree;
    bool is_musl, starts_half_back;
};

template <int D> class Mpm : public mpm_verify::Solver {
public:
    Mpm(const Problem& problem, Options options) : problem(problem), options(options) {
        x0 = grouped<Vector<D>>(problem.column("reference_position"));
        x = grouped<Vector<D>>(problem.column("position"));
        v = grouped<Vector<D>>(problem.column("velocity"));
        f = grouped<Matrix<D>>(problem.column("deformation_gradient"));
        sigma = grouped<Matrix<D>>(problem.column("stress"));
        m = problem.column("mass");
        vol0 = vol = problem.column("volume");
        for (std::size_t p = 0; p < x.size(); ++p) vol0[p] /= det(f[p]);
        const Json& material = problem["materials"].list.at(0);
        is_rate = material["law"].text == "linear_elastic";
        double young = material["parameters"]["young"].number();
        double poisson = material["parameters"]["poisson"].number();
        lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
        mu = young / (2 * (1 + poisson));

        const Json& grid = problem["grid"];
        h = grid["h"].number();
        std::size_t nodes = 1;
        for (std::size_t a = 0; a < D; ++a) {
            origin[a] = grid["origin"].list.at(a).number();
            cells[a] = int(grid["cells"].list.at(a).number());
            periodic[a] = grid["periodic"].list.at(a).value != 0;
            counts[a] = periodic[a] ? cells[a] : cells[a] + options.degree;
            nodes *= std::size_t(counts[a]);
        }
        mass.resize(nodes);
        velocity.resize(nodes);
        acceleration.resize(nodes);
        hold(problem["faces"].list);
        places.resize(x.size());
        weights.resize(x.size());
        for (std::size_t p = 0; p < x.size(); ++p) {
            places[p] = locate(p);
            check_volume(p);
        }
    }

    void advance(long steps, double dt, double time) override {
        for (long step = 0; step < steps; ++step) {
            for (std::size_t p = 0; p < x.size(); ++p) weigh(p);
            map_mass();
            map_acceleration(time + double(step) * dt);
            if (options.starts_half_back && !is_started) kick(-0.5 * dt);
            is_started = true;
            if (options.is_musl) {
                kick(dt);
                map_velocity();
            } else {
                map_velocity();
                for (std::size_t i = 0; i < mass.size(); ++i)
                    for (int a = 0; a < D; ++a) velocity[i][a] += dt * acceleration[i][a];
                kick(dt);
            }
            for (std::size_t p = 0; p < x.size(); ++p) move(p, dt);
        }
    }

    State state() const override {
        Column u = flat(x), reference = flat(x0);
        for (std::size_t i = 0; i < u.size(); ++i) u[i] -= reference[i];
        return State{{{"displacement", u}, {"velocity", flat(v)}, {"stress", flat(sigma)},
                      {"deformation_gradient", flat(f)}}, crossings, 0, min_j};
    }

private:
    struct Place {
        Vector<D> s;  // in cells
        std::array<int, D> cell;
    };
    struct NodeWeight {
        std::size_t node;
        double value;
        Vector<D> gradient;
    };

    const Problem& problem;
    Options options;
    bool is_rate, is_started = false;
    double lambda, mu, h, min_j = INFINITY;
    Vector<D> origin;
    std::array<int, D> cells, counts;
    std::array<bool, D> periodic;
    std::vector<Vector<D>> x0, x, v;
    std::vector<Matrix<D>> f, sigma;
    Column m, vol, vol0;
    std::vector<Place> places;
    std::vector<std::vector<NodeWeight>> weights;  // of all particles
    Column mass;
    std::vector<Vector<D>> velocity, acceleration;  // of the nodes
    std::vector<Vector<D>> is_free;                 // 0 where a wall holds a node, else 1
    unsigned long crossings = 0;

    // With knots repeated at walls, the first and the last function alone do not vanish there.
    void hold(const std::vector<Json>& faces) {
        is_free.assign(mass.size(), Vector<D>{});
        for (auto& components : is_free) components.fill(1);
        for (const Json& face : faces) {
            std::size_t axis = std::size_t(face["axis"].number()), stride = 1;
            for (std::size_t a = 0; a < axis; ++a) stride *= std::size_t(counts[a]);
            int end = face["high"].value != 0 ? counts[axis] - 1 : 0;
            for (std::size_t i = 0; i < mass.size(); ++i) {
                if (int(i / stride) % counts[axis] != end) continue;
                if (face["condition"].text == "fixed") is_free[i] = {};
                if (face["condition"].text == "roller") is_free[i][axis] = 0;
            }
        }
    }

    Place locate(std::size_t p) const {
        Place place;
        for (std::size_t a = 0; a < D; ++a) {
            double s = (x[p][a] - origin[a]) / h;
            if (periodic[a]) s -= cells[a] * std::floor(s / cells[a]);
            if (!(s >= 0 && s <= cells[a]))
                throw std::runtime_error("particle " + std::to_string(p) + " left the grid");
            place.s[a] = s;
            place.cell[a] = std::min(int(s), cells[a] - 1);
        }
        return place;
    }

    void weigh(std::size_t p) {
        const Place& place = places[p];
        std::vector<NodeWeight>& product = weights[p];
        product.assign(1, NodeWeight{0, 1, {}});
        std::size_t stride = 1;
        for (std::size_t a = 0; a < D; ++a) {  // times the functions along one more axis
            Functions along(options.degree, place.s[a], place.cell[a], cells[a], periodic[a]);
            std::size_t before = product.size();
            for (int r = options.degree; r >= 0; --r) {
                std::size_t index = std::size_t((place.cell[a] + r) % counts[a]);
                for (std::size_t k = 0; k < before; ++k) {
                    NodeWeight w = product[k];
                    w.node += stride * index;
                    for (std::size_t b = 0; b < a; ++b) w.gradient[b] *= along.value[r];
                    w.gradient[a] = w.value * along.slope[r] / h;
                    w.value *= along.value[r];
                    if (r > 0) product.push_back(w);
                    else product[k] = w;
                }
            }
            stride *= std::size_t(counts[a]);
        }
    }

    void map_mass() {
        std::fill(mass.begin(), mass.end(), 0.0);
        for (std::size_t p = 0; p < x.size(); ++p)
            for (const NodeWeight& w : weights[p]) mass[w.node] += m[p] * w.value;
    }

    // From momenta or forces to velocities or accelerations.
    void divide(std::vector<Vector<D>>& field) const {
        for (std::size_t i = 0; i < mass.size(); ++i)
            for (int a = 0; a < D; ++a)
                field[i][a] = mass[i] > 0 ? is_free[i][a] * field[i][a] / mass[i] : 0;
    }

    void map_acceleration(double time) {
        auto b = grouped<Vector<D>>(problem.body_force(time));
        if (b.size() != x.size()) throw std::runtime_error("a body force for other particles");
        acceleration.assign(mass.size(), Vector<D>{});
        for (std::size_t p = 0; p < x.size(); ++p)
            for (const NodeWeight& w : weights[p])
                for (int a = 0; a < D; ++a) {
                    double force = m[p] * b[p][a] * w.value;
                    for (int c = 0; c < D; ++c) force -= vol[p] * sigma[p][a][c] * w.gradient[c];
                    acceleration[w.node][a] += force;
                }
        divide(acceleration);
    }

    void map_velocity() {
        velocity.assign(mass.size(), Vector<D>{});
        for (std::size_t p = 0; p < x.size(); ++p)
            for (const NodeWeight& w : weights[p])
                for (int a = 0; a < D; ++a) velocity[w.node][a] += m[p] * v[p][a] * w.value;
        divide(velocity);
    }

    // FLIP: particles take the change of the grid's velocity.
    void kick(double dt) {
        for (std::size_t p = 0; p < x.size(); ++p)
            for (const NodeWeight& w : weights[p])
                for (int a = 0; a < D; ++a) v[p][a] += dt * acceleration[w.node][a] * w.value;
    }

    // Position, deformation and stress.
    void move(std::size_t p, double dt) {
        Vector<D> way{};
        Matrix<D> step{};
        for (const NodeWeight& w : weights[p])
            for (int a = 0; a < D; ++a) {
                way[a] += dt * velocity[w.node][a] * w.value;
                for (int c = 0; c < D; ++c) step[a][c] += dt * velocity[w.node][a] * w.gradient[c];
            }
        for (int a = 0; a < D; ++a) x[p][a] += way[a];
        Matrix<D> before = f[p], change = step;
        for (int a = 0; a < D; ++a) {
            change[a][a] += 1;
            for (int c = 0; c < D; ++c)
                for (int k = 0; k < D; ++k) f[p][a][c] += step[a][k] * before[k][c];
        }
        vol[p] = is_rate ? vol[p] * det(change) : vol0[p] * det(f[p]);
        check_volume(p);
        is_rate ? add_stress(p, step) : neo_hookean(p);
        Place now = locate(p);
        crossings += now.cell != places[p].cell;
        places[p] = now;
    }

    void check_volume(std::size_t p) {
        double j = vol[p] / vol0[p];
        if (!(j > 0)) throw std::runtime_error("particle " + std::to_string(p) + " is inside out");
        min_j = std::min(min_j, j);
    }

    // sigma += lambda tr(d eps) I + 2 mu d eps; strain is plane or uniaxial.
    void add_stress(std::size_t p, const Matrix<D>& step) {
        for (int a = 0; a < D; ++a)
            for (int c = 0; c < D; ++c) {
                sigma[p][a][a] += lambda * step[c][c];
                sigma[p][a][c] += mu * (step[a][c] + step[c][a]);
            }
    }

    // sigma = (lambda ln(J)/J) I + (mu/J) (F F^T - I).
    void neo_hookean(std::size_t p) {
        double j = det(f[p]);
        for (int a = 0; a < D; ++a)
            for (int c = 0; c < D; ++c) {
                double left = a == c ? -1 : 0;
                for (int k = 0; k < D; ++k) left += f[p][a][k] * f[p][c][k];
                sigma[p][a][c] = ((a == c ? lambda * std::log(j) : 0) + mu * left) / j;
            }
    }
};

int main(int count, char** words) {
    const std::map<std::string, int> degrees{
        {"linear", 1}, {"quadratic_bspline", 2}, {"cubic_bspline", 3}};
    std::map<std::string, std::string> flags{
        {"--basis", "linear"}, {"--scheme", "musl"}, {"--start", "at_zero"}};
    for (int i = 1; i + 1 < count; i += 2) flags[words[i]] = words[i + 1];
    if (count % 2 == 0 || flags.size() != 3 || !degrees.count(flags["--basis"])) {
        std::cerr << "usage: mpm [--basis linear|quadratic_bspline|cubic_bspline] "
                     "[--scheme musl|usl] [--start at_zero|half_step_back]\n";
        return 2;
    }
    const Options options{degrees.at(flags["--basis"]), flags["--scheme"] == "musl",
                          flags["--start"] == "half_step_back"};
    const mpm_verify::About about{
        "cpp-mpm", "1.0", 2,
        R"({"dimensions": [1, 2], "laws": ["linear_elastic", "neo_hookean"], )"
        R"("conditions": ["free", "fixed", "roller", "periodic"], )"
        R"("loads": ["gravity", "body_force"], "columns": ["stress", "deformation_gradient"], )"
        R"("manufactured": true, "initial_deformation": true, "binary": true})"};
    return mpm_verify::serve(about, [&](const Problem& problem) {
        std::unique_ptr<mpm_verify::Solver> solver;
        if (problem["dimension"].number() == 1) solver.reset(new Mpm<1>(problem, options));
        else solver.reset(new Mpm<2>(problem, options));
        return solver;
    });
}
