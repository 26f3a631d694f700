!> An explicit MPM of a bar, with linear functions, FLIP and MUSL, as a solver under test.
!>
!>     gfortran -O2 -o bar mpm_verify.f90 bar.f90
!>     mpm-verify run vibrating-bar --solver ./bar
!>     mpm-verify run bar-under-gravity --solver './bar --start-half-step-back'
!>
!> Sulsky, Chen & Schreyer (1994) and Sulsky, Zhou & Schreyer (1995), with a lumped mass matrix.
program bar
  use mpm_verify
  implicit none
  character(*), parameter :: hello = '{"type":"hello","protocol":2,"name":"fortran-bar",' // &
    '"version":"1.0","formal_order":2,"capabilities":{"dimensions":[1],' // &
    '"laws":["linear_elastic"],"conditions":["free","fixed","roller","periodic"],' // &
    '"loads":["gravity","body_force"],"columns":["stress"],"manufactured":true,' // &
    '"initial_deformation":true,"binary":true}}'
  type(message_t) :: request, problem
  real(dp), allocatable :: x0(:), x(:), v(:), m(:), vol(:), vol0(:), sigma(:), xi(:)
  integer, allocatable :: low(:), high(:), cell(:)
  real(dp) :: h, origin, modulus, min_j
  integer :: cells, crossings
  logical :: periodic, is_held(2), starts_half_back, is_started
  character(:), allocatable :: failure
  character(32) :: option

  call get_command_argument(1, option)
  starts_half_back = option == '--start-half-step-back'

  call open_channel
  do
    call receive(request)
    select case (text_of(request, 'type'))
    case ('hello')
      call say(hello)
    case ('problem')
      problem = request
      call set_up
      call say('{"type":"ready"}')
    case ('advance')
      call advance(nint(number_of(request, 'steps')), number_of(request, 'dt'), &
        number_of(request, 'from'))
      if (allocated(failure)) then
        call say('{"type":"failed","reason":"' // failure // '"}')
      else
        call send_state
      end if
    case ('bye')
      exit
    end select
  end do

contains

  subroutine set_up
    real(dp) :: young, poisson
    integer :: face
    character(:), allocatable :: at
    x0 = column(problem, 'particles.reference_position')
    x = column(problem, 'particles.position')
    v = column(problem, 'particles.velocity')
    m = column(problem, 'particles.mass')
    vol = column(problem, 'particles.volume')
    vol0 = vol / column(problem, 'particles.deformation_gradient')
    sigma = column(problem, 'particles.stress')
    young = number_of(problem, 'materials.0.parameters.young')
    poisson = number_of(problem, 'materials.0.parameters.poisson')
    modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
    h = number_of(problem, 'grid.h')
    origin = number_of(problem, 'grid.origin.0')
    cells = nint(number_of(problem, 'grid.cells.0'))
    periodic = text_of(problem, 'grid.periodic.0') == 'true'
    is_held = .false.
    do face = 0, 1
      at = 'faces.' // achar(iachar('0') + face)
      if (.not. has(problem, at)) exit
      if (index('fixed roller', text_of(problem, at // '.condition')) > 0) &
        is_held(merge(2, 1, text_of(problem, at // '.high') == 'true')) = .true.
    end do
    crossings = 0
    is_started = .false.
    min_j = minval(vol / vol0)
    allocate (xi(size(x)), low(size(x)), high(size(x)))
    allocate (cell(size(x)), source=0)
    call locate
    crossings = 0
  end subroutine

  !> The cells of the particles, their nodes, and the places in them, from 0 to 1.
  subroutine locate
    real(dp) :: s
    integer :: p, now
    do p = 1, size(x)
      s = (x(p) - origin) / h
      if (periodic) s = modulo(s, real(cells, dp))
      if (.not. (s >= 0 .and. s <= cells)) then
        failure = 'a particle left the grid'
        return
      end if
      now = min(int(s), cells - 1)
      if (now /= cell(p)) crossings = crossings + 1
      cell(p) = now
      xi(p) = s - now
      low(p) = now + 1
      high(p) = merge(1, now + 2, periodic .and. now == cells - 1)
    end do
  end subroutine

  subroutine advance(steps, dt, from)
    integer, intent(in) :: steps
    real(dp), intent(in) :: dt, from
    real(dp), dimension(cells + 1) :: mass, acceleration, velocity
    real(dp) :: change(size(x))
    integer :: step
    do step = 0, steps - 1
      mass = mapped(m, 0 * m)
      acceleration = per_mass(mapped(m * body_force(problem, from + step * dt), -vol * sigma), mass)
      ! Velocities at half steps: the first step starts from half a step before t = 0.
      if (starts_half_back .and. .not. is_started) v = v - dt / 2 * at_particles(acceleration)
      is_started = .true.
      v = v + dt * at_particles(acceleration)
      velocity = per_mass(mapped(m * v, 0 * v), mass)
      change = dt * (velocity(high) - velocity(low)) / h
      x = x + dt * at_particles(velocity)
      vol = vol * (1 + change)
      sigma = sigma + modulus * change
      min_j = min(min_j, minval(vol / vol0))
      if (.not. min_j > 0) failure = 'a particle is inside out'
      call locate
      if (allocated(failure)) return
    end do
  end subroutine

  !> Sums at the nodes of values times functions and of fluxes times gradients.
  function mapped(value, flux) result(field)
    real(dp), intent(in) :: value(:), flux(:)
    real(dp) :: field(cells + 1)
    integer :: p
    field = 0
    do p = 1, size(x)
      field(low(p)) = field(low(p)) + value(p) * (1 - xi(p)) - flux(p) / h
      field(high(p)) = field(high(p)) + value(p) * xi(p) + flux(p) / h
    end do
  end function

  !> A nodal field divided by the nodal mass; zero where a wall holds the node.
  function per_mass(field, mass) result(quotient)
    real(dp), intent(in) :: field(:), mass(:)
    real(dp) :: quotient(cells + 1)
    quotient = 0
    where (mass > 0) quotient = field / mass
    if (is_held(1)) quotient(1) = 0
    if (is_held(2)) quotient(cells + 1) = 0
  end function

  function at_particles(field) result(value)
    real(dp), intent(in) :: field(:)
    real(dp) :: value(size(x))
    value = field(low) * (1 - xi) + field(high) * xi
  end function

  subroutine send_state
    type(outgoing_t) :: state
    call append(state, 'displacement', x - x0)
    call append(state, 'velocity', v)
    call append(state, 'stress', sigma)
    call send(state, crossings, min_j)
  end subroutine
end program
