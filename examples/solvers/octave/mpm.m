function mpm(varargin)
% An explicit MPM in one or two dimensions, in GNU Octave, as a solver under test.
%
%     octave-cli -qfH --path examples/solvers/octave --eval mpm
%     octave-cli -qfH --path examples/solvers/octave --eval 'mpm --scheme usl --start half_step_back'
%
% Linear functions, FLIP, and MUSL or USL: Sulsky, Chen & Schreyer (1994) and Sulsky, Zhou &
% Schreyer (1995). With `half_step_back` the first velocity is taken to the time -dt/2.
  solver.name = 'octave-mpm';
  solver.version = '1.0';
  solver.capabilities.dimensions = [1 2];
  solver.capabilities.laws = {'linear_elastic', 'neo_hookean'};
  solver.capabilities.conditions = {'free', 'fixed', 'roller', 'periodic'};
  solver.capabilities.loads = {'gravity', 'body_force'};
  solver.capabilities.columns = {'stress', 'deformation_gradient'};
  solver.capabilities.manufactured = true;
  solver.capabilities.initial_deformation = true;
  solver.setup = @(problem) setup(problem, varargin);
  solver.advance = @advance;
  solver.state = @state;
  mpm_verify_serve(solver);
end

function sim = setup(problem, options)
  sim.problem = problem;
  sim.is_usl = any(strcmp('usl', options));
  sim.starts_half_back = any(strcmp('half_step_back', options));
  sim.x = problem.position;
  sim.v = problem.velocity;
  sim.f = problem.deformation_gradient;
  sim.sigma = problem.stress;
  sim.vol = problem.volume;
  sim.vol0 = sim.vol ./ determinant(sim.f);
  sim.law = problem.materials{1}.law;
  young = problem.materials{1}.parameters.young;
  poisson = problem.materials{1}.parameters.poisson;
  sim.lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  sim.mu = young / (2 * (1 + poisson));
  % Nodes are numbered along the first axis first. `free` is 0 where a wall holds a component.
  sim.counts = problem.cells + ~problem.periodic;
  sim.strides = [1, sim.counts(1:end - 1)];
  index = mod(floor((0:prod(sim.counts) - 1).' ./ sim.strides), sim.counts);
  sim.free = ones(size(index));
  for k = 1:numel(problem.faces)
    face = problem.faces{k};
    axis = face.axis + 1;
    wall = index(:, axis) == face.high * (sim.counts(axis) - 1);
    if strcmp(face.condition, 'fixed'), sim.free(wall, :) = 0; end
    if strcmp(face.condition, 'roller'), sim.free(wall, axis) = 0; end
  end
  sim.min_j = min(sim.vol ./ sim.vol0);
  sim.crossings = 0;
  sim = locate(sim);
end

function sim = advance(sim, steps, dt, time)
  for k = 0:steps - 1, sim = step(sim, dt, time + k * dt); end
end

function s = state(sim)
  s = struct('displacement', sim.x - sim.problem.reference_position, 'velocity', sim.v, ...
    'stress', sim.sigma, 'deformation_gradient', sim.f, 'crossings', sim.crossings, ...
    'min_j', sim.min_j);
end

function sim = step(sim, dt, time)
  d = sim.problem.dimension;
  m = sim.problem.mass;
  [shapes, gradients] = weigh(sim);
  mass = shapes * m;
  force = shapes * (m .* sim.problem.body_force(time));
  for i = 1:d
    for j = 1:d
      force(:, i) = force(:, i) - gradients{j} * (sim.vol .* sim.sigma(:, i, j));
    end
  end
  acceleration = per_mass(force, mass, sim.free);
  change = dt * (shapes.' * acceleration);
  if sim.starts_half_back, sim.v = sim.v - change / 2; end
  sim.starts_half_back = false;
  velocity = per_mass(shapes * (m .* sim.v), mass, sim.free) + dt * acceleration;
  sim.v = sim.v + change;
  if ~sim.is_usl, velocity = per_mass(shapes * (m .* sim.v), mass, sim.free); end
  increment = zeros(size(sim.f));  % velocity gradient times dt
  for j = 1:d
    increment(:, :, j) = dt * (gradients{j}.' * velocity);
  end
  sim = strain(sim, increment);
  sim.x = sim.x + dt * (shapes.' * velocity);
  before = sim.cell;
  sim = locate(sim);
  sim.crossings = sim.crossings + sum(any(sim.cell ~= before, 2));
end

function sim = strain(sim, increment)
  % Deformation, volume and stress after a velocity gradient times dt.
  sim.f = sim.f + product(increment, sim.f);
  j = determinant(sim.f);
  if ~all(j > 0), error('particle %d is inside out', find(~(j > 0), 1) - 1); end
  sim.min_j = min(sim.min_j, min(j));
  sim.vol = sim.vol0 .* j;
  d = size(sim.f, 2);
  one = reshape(eye(d), [1 d d]);
  if strcmp(sim.law, 'linear_elastic')
    e = (increment + permute(increment, [1 3 2])) / 2;
    sim.sigma = sim.sigma + sim.lambda * sum(sum(e .* one, 2), 3) .* one + 2 * sim.mu * e;
  else
    left = product(sim.f, permute(sim.f, [1 3 2]));
    sim.sigma = ((sim.lambda * log(j) - sim.mu) .* one + sim.mu * left) ./ j;
  end
end

function sim = locate(sim)
  % Positions of the particles in the grid, in cells, and their cells.
  cells = sim.problem.cells;
  s = (sim.x - sim.problem.origin) / sim.problem.h;
  s = s - sim.problem.periodic .* cells .* floor(s ./ cells);
  outside = ~all(s >= 0 & s <= cells, 2);
  if any(outside), error('particle %d left the grid', find(outside, 1) - 1); end
  sim.cell = min(floor(s), cells - 1);
  sim.xi = s - sim.cell;
end

function [shapes, gradients] = weigh(sim)
  % Functions, and their gradients along each axis, as sparse matrices of nodes x particles.
  [n, d] = size(sim.x);
  node = zeros(n, 2^d);
  value = zeros(n, 2^d, d + 1);
  for corner = 1:2^d
    high = bitget(corner - 1, 1:d);
    along = high .* sim.xi + (1 - high) .* (1 - sim.xi);
    node(:, corner) = 1 + mod(sim.cell + high, sim.counts) * sim.strides.';
    value(:, corner, d + 1) = prod(along, 2);
    for axis = 1:d
      slope = (2 * high(axis) - 1) / sim.problem.h;
      value(:, corner, axis) = slope * prod(along(:, (1:d) ~= axis), 2);
    end
  end
  matrix = @(k) sparse(node, repmat((1:n).', 1, 2^d), value(:, :, k), prod(sim.counts), n);
  shapes = matrix(d + 1);
  gradients = arrayfun(matrix, 1:d, 'UniformOutput', false);
end

function field = per_mass(sums, mass, free)
  % Nodal sums divided by the nodal mass: zero at nodes without mass, and where a wall holds them.
  mass(mass == 0) = Inf;
  field = free .* sums ./ mass;
end

function c = product(a, b)
  % Products of matrices, one for each particle.
  c = zeros(size(a));
  for k = 1:size(a, 3), c = c + a(:, :, k) .* b(:, k, :); end
end

function j = determinant(f)
  j = f(:, 1, 1);
  if size(f, 2) == 2, j = j .* f(:, 2, 2) - f(:, 1, 2) .* f(:, 2, 1); end
end
