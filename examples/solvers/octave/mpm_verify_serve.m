function mpm_verify_serve(solver)
% Version 2 of the solver protocol of `mpm-verify` for GNU Octave 7 or later: see docs/protocol.md.
%
% `solver` is a struct with these fields:
%   name, version   texts; `name` has letters, digits, `-`, `_` and `.`
%   capabilities    struct, such as dimensions = [1 2], laws = {'linear_elastic'}
%   formal_order, precision   optional: see `hello` in docs/protocol.md
%   setup           sim = setup(problem): takes the initial state. `sim` may be any value
%   advance         sim = advance(sim, steps, dt, time): steps of length dt (s), from `time` (s)
%   state           s = state(sim): struct with `displacement` (m) and `velocity` (m/s), n x D.
%                   Optional: `stress` (Pa) and `deformation_gradient`, n x D x D; `stress_across`
%                   and `temperature`, n x 1; the numbers `crossings`, `left_domain` and `min_j`
%
% `problem` has, for n particles in D dimensions, in m, s and kg:
%   dimension, h, dt, plane, contact            as in the message
%   origin, cells, periodic                     1 x D
%   faces, materials, bodies, loads             cell arrays of structs; `axis` counts from 0
%   position, velocity, reference_position      n x D
%   mass, volume, reference_volume, body        n x 1; `body` counts from 0
%   deformation_gradient, stress                n x D x D: (p, i, j) is a component of particle p
%   message                                     the message `problem`
%   body_force(t)                               force per mass (n x D, m/s2) at time t (s)
%   values(of, key, value, ...)                 one column of numbers: the request `values`, such as
%                                               values('load:1', 't', t, 'reference_position', x)
%
% An error in the solver fails the level. error('mpm_verify:cannot', REASON) rejects a problem.
% Everything that the solver prints goes to standard error.
  require_fields(solver, 'solver', {'name', 'version', 'capabilities', 'setup', 'advance', 'state'});
  output = fopen('/dev/stdout', 'w');
  dup2(stderr, stdout);
  while true
    [request, block] = receive();
    try
      switch request.type
        case 'hello'
          answer = hello(solver);
        case 'problem'
          problem = read_problem(request, block, output);
          sim = solver.setup(problem);
          answer = struct('type', 'ready');
        case 'advance'
          sim = solver.advance(sim, request.steps, request.dt, request.from);
          answer = state_message(solver.state(sim), size(problem.position));
        case 'bye'
          return
        otherwise
          error('the request `%s` is not supported', request.type);
      end
    catch err
      answer = struct('type', 'failed', 'reason', strtrim(regexprep(err.message, '\s+', ' ')));
      place = err.stack(1);
      if strcmp(err.identifier, 'mpm_verify:cannot')
        answer.type = 'cannot';
      elseif ~strncmp(place.name, 'mpm_verify_serve', 16)
        answer.reason = sprintf('%s (%s, line %d)', answer.reason, place.name, place.line);
      end
    end
    send(output, answer);
  end
end

function require_fields(value, name, fields)
  missing = fields(~isfield(value, fields));
  if ~isempty(missing), error('the %s lacks the field `%s`\n', name, missing{1}); end
end

function text = hello(solver)
  message = struct('type', 'hello', 'protocol', 2);
  solver.capabilities.binary = true;
  for key = fieldnames(solver.capabilities).'
    value = solver.capabilities.(key{1});
    % jsonencode writes a list of one entry only for a cell array.
    if ischar(value), value = {value}; elseif isnumeric(value), value = num2cell(value); end
    solver.capabilities.(key{1}) = value;
  end
  for key = {'name', 'version', 'capabilities', 'formal_order', 'precision'}
    if isfield(solver, key{1}), message.(key{1}) = solver.(key{1}); end
  end
  text = jsonencode(message);
end

function problem = read_problem(message, block, output)
  d = message.dimension;
  problem = struct('message', message, 'dimension', d, 'h', message.grid.h, 'dt', message.dt, ...
    'plane', message.plane, 'contact', message.contact);
  for key = {'origin', 'cells', 'periodic'}
    problem.(key{1}) = reshape(message.grid.(key{1}), 1, d);
  end
  for key = {'faces', 'materials', 'bodies', 'loads'}
    entries = message.(key{1});  % a struct array if all entries have the same keys
    if ~iscell(entries), entries = num2cell(entries); end
    problem.(key{1}) = entries;
  end
  n = numel(column(message.particles.mass, block));
  for key = fieldnames(message.particles).'
    values = reshape(column(message.particles.(key{1}), block), [], n).';
    if any(strcmp(key{1}, {'deformation_gradient', 'stress', 'initial_stress'}))
      values = permute(reshape(values, n, d, d), [1 3 2]);  % tensors are sent row by row
    end
    problem.(key{1}) = values;
  end
  problem.values = @(of, varargin) request_values(output, of, varargin{:});
  problem.body_force = @(t) reshape(request_values(output, 'body_force', 't', t), d, n).';
  if strcmp(message.body_force, 'none'), problem.body_force = @(t) zeros(n, d); end
  if strcmp(message.body_force, 'constant')
    problem.body_force = @(t) repmat(reshape(message.body_force_value, 1, d), n, 1);
  end
end

function values = request_values(output, of, varargin)
  request = struct('type', 'values', 'of', of, varargin{:});
  for key = intersect(fieldnames(request), {'reference_position', 'displacement'}).'
    request.(key{1}) = {request.(key{1})};
  end
  send(output, request);
  [answer, block] = receive();
  if isfield(answer, 'error'), error('values of %s: %s', of, answer.error); end
  values = column(answer.values, block);
end

function message = state_message(state, shape)
  n = shape(1); d = shape(2);
  widths = struct('displacement', d, 'velocity', d, 'stress', d^2, 'stress_across', 1, ...
    'deformation_gradient', d^2, 'temperature', 1);
  require_fields(state, 'state', {'displacement', 'velocity'});
  message = struct('type', 'state', 'columns', struct());
  for key = fieldnames(state).'
    name = key{1}; value = state.(name);
    if any(strcmp(name, {'crossings', 'left_domain', 'min_j'}))
      if ~(isscalar(value) && isfinite(value)), error('`%s` is not a finite number', name); end
      message.(name) = value;
    elseif ~isfield(widths, name)
      error('the state has the unknown field `%s`', name);
    elseif ~(isreal(value) && rows(value) == n && numel(value) == n * widths.(name))
      error('`%s` is %s; expected a real array of %d particles x %d components', name, ...
        strjoin(cellstr(num2str(size(value).')), ' x '), n, widths.(name));
    else
      message.columns.(name) = {value};
    end
  end
end

function [message, block] = receive()
  % The next message, and its block of bytes. fgetl would wait for the byte after the newline.
  line = fscanf(stdin, '%[^\n]', 'C');
  if isempty(fread(stdin, 1)), error('the harness has closed the connection'); end
  message = jsondecode(line);
  block = uint8([]);
  if isfield(message, 'bytes'), block = fread(stdin, message.bytes, '*uint8'); end
end

function values = column(place, block)
  % A column of a message: numbers, or the position of their bytes.
  values = place(:);
  if isstruct(place), values = typecast(block(place.f64(1) + (1:8 * place.f64(2))), 'double'); end
end

function send(output, message)
  block = uint8([]);
  if isstruct(message), [message, block] = encode(message, block); end
  if ~isempty(block), message = sprintf('%s,"bytes":%d}', message(1:end - 1), numel(block)); end
  fwrite(output, [uint8(message), 10, block]);
  fflush(output);
end

function [text, block] = encode(value, block)
  % JSON of a value. A cell {x} is a column: its numbers are added to `block`, by particles.
  if isstruct(value)
    parts = {};
    for key = fieldnames(value).'
      [inner, block] = encode(value.(key{1}), block);
      parts{end + 1} = ['"' key{1} '":' inner];
    end
    text = ['{' strjoin(parts, ',') '}'];
  elseif iscell(value)
    numbers = reshape(permute(double(full(value{1})), [3 2 1]), 1, []);
    text = sprintf('{"f64":[%d,%d]}', numel(block), numel(numbers));
    block = [block, typecast(numbers, 'uint8')];
  elseif ischar(value)
    text = jsonencode(value);
  else
    text = sprintf('%.17g', value);  % jsonencode writes 16 digits, and 1e-16 as 0
  end
end
