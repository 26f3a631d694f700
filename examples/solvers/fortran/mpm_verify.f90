!> Version 2 of the solver protocol of mpm-verify in Fortran 2008: see docs/protocol.md.
!>
!> Columns are sent as bytes; the machine must be little-endian. A solver must print to `error_unit`
!> only, because other output would mix with the messages.
module mpm_verify
  use, intrinsic :: iso_fortran_env, only: real64, int64, error_unit
  implicit none
  private
  public :: open_channel, receive, send, say, text_of, number_of, has, column, body_force, values, append

  integer, parameter, public :: dp = real64

  !> A message: a line of JSON, and the bytes of its columns.
  type, public :: message_t
    character(:), allocatable :: line
    character(1), allocatable :: bytes(:)
  end type

  !> A message on its way out.
  type, public :: outgoing_t
    character(:), allocatable :: columns
    real(dp), allocatable :: numbers(:)
  end type

  integer :: input, output

contains

  subroutine open_channel
    open (newunit=input, file='/dev/stdin', access='stream', form='unformatted', action='read')
    open (newunit=output, file='/dev/stdout', access='stream', form='unformatted', action='write')
  end subroutine

  !> The next message; the program ends if there is none.
  subroutine receive(message)
    type(message_t), intent(out) :: message
    character(:), allocatable :: buffer
    character(1) :: sign
    integer :: length, status
    allocate (character(1024) :: buffer)
    length = 0
    do
      read (input, iostat=status) sign
      if (status /= 0) stop 1
      if (sign == new_line(sign)) exit
      if (length == len(buffer)) buffer = buffer // repeat(' ', length)
      length = length + 1
      buffer(length:length) = sign
    end do
    message%line = buffer(:length)
    length = 0
    if (has(message, 'bytes')) length = nint(number_of(message, 'bytes'))
    allocate (message%bytes(length))
    read (input, iostat=status) message%bytes
    if (status /= 0) stop 1
  end subroutine

  !> Sends one line of JSON.
  subroutine say(line)
    character(*), intent(in) :: line
    write (output) line // new_line('a')
    flush (output)
  end subroutine

  !> Adds a column to a state.
  subroutine append(state, name, numbers)
    type(outgoing_t), intent(inout) :: state
    character(*), intent(in) :: name
    real(dp), intent(in) :: numbers(:)
    character(64) :: place
    if (.not. allocated(state%numbers)) then
      allocate (state%numbers(0))
      state%columns = ''
    end if
    write (place, '(a,i0,a,i0,a)') '":{"f64":[', 8 * size(state%numbers), ',', size(numbers), ']}'
    if (len(state%columns) > 0) state%columns = state%columns // ','
    state%columns = state%columns // '"' // name // trim(place)
    state%numbers = [state%numbers, numbers]
  end subroutine

  !> Sends a state with its counters.
  subroutine send(state, crossings, min_j)
    type(outgoing_t), intent(in) :: state
    integer, intent(in) :: crossings
    real(dp), intent(in) :: min_j
    character(160) :: counters
    write (counters, '(a,i0,a,i0,a,es24.16e3,a)') '},"bytes":', 8 * size(state%numbers), &
      ',"crossings":', crossings, ',"min_j":', min_j, '}'
    write (output) '{"type":"state","columns":{' // state%columns // trim(counters) // new_line('a')
    write (output) state%numbers
    flush (output)
  end subroutine

  !> Where the value at a path of keys, with points between them, begins in a message; 0 if it is
  !> not there. A number in the path counts the entries of a list, from 0 on.
  integer function place_of(message, path) result(at)
    type(message_t), intent(in) :: message
    character(*), intent(in) :: path
    integer :: first, last
    at = blank(message%line, 1)
    first = 1
    do while (first <= len(path) .and. at > 0)
      last = index(path(first:) // '.', '.') + first - 2
      at = entry(message%line, at, path(first:last))
      first = last + 2
    end do
  end function

  !> The entry of the object or list that begins at `from`; 0 if there is none.
  integer function entry(json, from, key) result(at)
    character(*), intent(in) :: json, key
    integer, intent(in) :: from
    character(:), allocatable :: name
    character(12) :: number
    integer :: count, behind
    at = blank(json, from + 1)
    name = ''
    do count = 0, len(json)
      if (index(']}', json(at:at)) > 0) exit
      if (json(from:from) == '{') then
        behind = skipped(json, at)
        name = json(at + 1:behind - 2)
        at = blank(json, blank(json, behind) + 1)
      else
        write (number, '(i0)') count
        name = trim(number)
      end if
      if (name == key) return
      at = blank(json, skipped(json, at))
      if (json(at:at) == ',') at = blank(json, at + 1)
    end do
    at = 0
  end function

  !> The first place from `at` on that is not blank.
  pure integer function blank(json, at) result(next)
    character(*), intent(in) :: json
    integer, intent(in) :: at
    next = at + verify(json(at:) // '.', ' ' // char(9) // char(13)) - 1
  end function

  !> The place behind the value that begins at `from`.
  integer function skipped(json, from) result(at)
    character(*), intent(in) :: json
    integer, intent(in) :: from
    integer :: depth
    logical :: in_text
    depth = 0
    in_text = .false.
    at = from
    do while (at <= len(json))
      if (in_text .and. json(at:at) == '\') then
        at = at + 1
      else if (json(at:at) == '"') then
        in_text = .not. in_text
      else if (.not. in_text) then
        if (index('[{', json(at:at)) > 0) depth = depth + 1
        if (index(']}', json(at:at)) > 0) depth = depth - 1
      end if
      at = at + 1
      if (at > len(json)) exit
      if (.not. in_text .and. depth == 0 .and. index(',]}: ', json(at:at)) > 0) exit
    end do
  end function

  logical function has(message, path)
    type(message_t), intent(in) :: message
    character(*), intent(in) :: path
    has = place_of(message, path) > 0
  end function

  !> The value at a path, as it is written; text without its quotes.
  function text_of(message, path) result(text)
    type(message_t), intent(in) :: message
    character(*), intent(in) :: path
    character(:), allocatable :: text
    integer :: at
    at = place_of(message, path)
    if (at == 0) then
      write (error_unit, '(a)') 'a message lacks ' // path
      stop 1
    end if
    text = message%line(at:skipped(message%line, at) - 1)
    if (text(1:1) == '"') text = text(2:len(text) - 1)
  end function

  real(dp) function number_of(message, path) result(number)
    type(message_t), intent(in) :: message
    character(*), intent(in) :: path
    character(:), allocatable :: text
    text = text_of(message, path)
    read (text, *) number
  end function

  !> A column of numbers: those at the place in the bytes that the message names.
  function column(message, path) result(numbers)
    type(message_t), intent(in) :: message
    character(*), intent(in) :: path
    real(dp), allocatable :: numbers(:)
    integer :: offset, count
    offset = nint(number_of(message, path // '.f64.0'))
    count = nint(number_of(message, path // '.f64.1'))
    numbers = transfer(message%bytes(offset + 1:offset + 8 * count), numbers, count)
  end function

  !> Force per unit of mass (m/s2) at the particles at time `t` (s).
  function body_force(problem, t) result(b)
    type(message_t), intent(in) :: problem
    real(dp), intent(in) :: t
    real(dp), allocatable :: b(:)
    integer :: axis, d
    b = 0 * column(problem, 'particles.position')
    select case (text_of(problem, 'body_force'))
    case ('constant')
      d = nint(number_of(problem, 'dimension'))
      do axis = 1, d
        b(axis::d) = number_of(problem, 'body_force_value.' // achar(iachar('0') + axis - 1))
      end do
    case ('asked')
      b = values('body_force', t)
    end select
  end function

  !> Values of a field at time `t` (s): `of` is body_force, displacement, velocity,
  !> deformation_gradient, stress, initial_stress, load:INDEX or face:NAME. Fields of the initial
  !> state take t = 0. Without `places` (reference positions in m, one place after the other), the
  !> values are those at the particles, or of a quantity that is the same everywhere.
  function values(of, t, places) result(numbers)
    character(*), intent(in) :: of
    real(dp), intent(in) :: t
    real(dp), intent(in), optional :: places(:)
    real(dp), allocatable :: numbers(:)
    type(message_t) :: answer
    character(64) :: text
    integer :: bytes
    character(:), allocatable :: request
    write (text, '(es24.16e3)') t
    request = '{"type":"values","of":"' // of // '","t":' // trim(adjustl(text))
    if (present(places)) then
      bytes = 8 * size(places)
      write (text, '(a,i0,a,i0,a)') '{"f64":[0,', size(places), ']},"bytes":', bytes, '}'
      write (output) request // ',"reference_position":' // trim(text) // new_line('a'), places
      flush (output)
    else
      call say(request // '}')
    end if
    call receive(answer)
    if (has(answer, 'error')) then
      write (error_unit, '(a)') 'no values of ' // of // ': ' // text_of(answer, 'error')
      stop 1
    end if
    numbers = column(answer, 'values')
  end function
end module
