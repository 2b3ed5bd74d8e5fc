/* What each rank sends, receives and computes in each stage of a program that
   announces its stages by MPI_Pcontrol(1, "name"): a library between the
   program and MPI, for tests/benchmarks/scaling.py.

   mpicc -O2 -shared -fPIC -o mpi_counts.so mpi_counts.c
   MPI_COUNTS=DIRECTORY mpirun -n 8 -x LD_PRELOAD=./mpi_counts.so -x MPI_COUNTS
   program

   At MPI_Finalize rank r writes DIRECTORY/r.csv with one line per stage. Calls
   from C and those from Fortran that MUMPS makes are counted; persistent
   communication ends the program, so that it is not missed in silence;
   one-sided communication is not looked for. CPU time is that outside of MPI,
   where ranks that share a core only wait. */
#define _GNU_SOURCE
#include <mpi.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

enum
{
  max_stages = 64
};

struct Stage
{
  char    name[48];
  double  sent, bytes_sent;              /* point to point */
  double *messages_to, *bytes_to;        /* the same by rank of the world */
  double  collectives, collective_bytes; /* given and got by this rank */
  double  cpu, wall, wall_mpi;           /* cpu: outside of MPI */
  long    peak_kib; /* of the process when the stage was left last */
};

static struct Stage stages[max_stages];
static int          n_stages, current, depth, world_size;
static double       cpu_entered, wall_entered, cpu_called, wall_called;

static double
now(clockid_t clock)
{
  struct timespec t;
  clock_gettime(clock, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void
leave_stage(void)
{
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  stages[current].cpu += now(CLOCK_THREAD_CPUTIME_ID) - cpu_entered;
  stages[current].wall += now(CLOCK_MONOTONIC) - wall_entered;
  stages[current].peak_kib = usage.ru_maxrss;
}

static void
enter_stage(const char *name)
{
  for (current = 0;
       current < n_stages && strcmp(stages[current].name, name) != 0;)
    ++current;
  if (current == max_stages)
    PMPI_Abort(MPI_COMM_WORLD, 1);
  if (current == n_stages)
    {
      if (world_size == 0)
        PMPI_Comm_size(MPI_COMM_WORLD, &world_size);
      snprintf(stages[n_stages].name, sizeof stages[n_stages].name, "%s", name);
      stages[n_stages].messages_to = calloc(world_size, sizeof(double));
      stages[n_stages].bytes_to    = calloc(world_size, sizeof(double));
      ++n_stages;
    }
  cpu_entered  = now(CLOCK_THREAD_CPUTIME_ID);
  wall_entered = now(CLOCK_MONOTONIC);
}

int
MPI_Pcontrol(const int level, ...)
{
  va_list arguments;
  va_start(arguments, level);
  if (level == 1)
    {
      if (n_stages > 0)
        leave_stage();
      enter_stage(va_arg(arguments, const char *));
    }
  va_end(arguments);
  return MPI_SUCCESS;
}

/* Around each call: only the outermost counts. */
static void
begin(void)
{
  if (n_stages == 0)
    enter_stage("start");
  if (depth++ == 0)
    {
      cpu_called  = now(CLOCK_THREAD_CPUTIME_ID);
      wall_called = now(CLOCK_MONOTONIC);
    }
}

static int
end(int result)
{
  if (--depth == 0)
    {
      stages[current].cpu -= now(CLOCK_THREAD_CPUTIME_ID) - cpu_called;
      stages[current].wall_mpi += now(CLOCK_MONOTONIC) - wall_called;
    }
  return result;
}

static double
size_of(double count, MPI_Datatype type)
{
  int size = 0;
  if (count != 0 && type != MPI_DATATYPE_NULL)
    PMPI_Type_size(type, &size);
  return count * size;
}

static void
message(int count, MPI_Datatype type, int to, MPI_Comm comm)
{
  begin();
  if (depth != 1 || to == MPI_PROC_NULL)
    return;
  MPI_Group mine, world;
  int       rank = to;
  PMPI_Comm_group(comm, &mine);
  PMPI_Comm_group(MPI_COMM_WORLD, &world);
  PMPI_Group_translate_ranks(mine, 1, &to, world, &rank);
  PMPI_Group_free(&mine);
  PMPI_Group_free(&world);
  const double bytes = size_of(count, type);
  stages[current].sent += 1;
  stages[current].bytes_sent += bytes;
  stages[current].messages_to[rank] += 1;
  stages[current].bytes_to[rank] += bytes;
}

static void
collective(double bytes)
{
  begin();
  if (depth == 1)
    {
      stages[current].collectives += 1;
      stages[current].collective_bytes += bytes;
    }
}

static int
size(MPI_Comm comm)
{
  int n;
  PMPI_Comm_size(comm, &n);
  return n;
}

static int
is_root(int root, MPI_Comm comm)
{
  int rank;
  PMPI_Comm_rank(comm, &rank);
  return rank == root;
}

static double
total(const int *counts, MPI_Comm comm)
{
  double sum = 0;
  for (int r = 0; r < size(comm); ++r)
    sum += counts[r];
  return sum;
}

/* clang-format off */
/* One C call: its declaration, its arguments, what is counted before it. */
#define WRAP(name, declaration, arguments, count) \
  int MPI_##name declaration                      \
  {                                               \
    count;                                        \
    return end(PMPI_##name arguments);            \
  }
#define SEND(name)                                                                           \
  WRAP(name, (const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c), (b, n, t, to, tag, c), \
       message(n, t, to, c))
#define ISEND(name)                                                                            \
  WRAP(name, (const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request *r), \
       (b, n, t, to, tag, c, r), message(n, t, to, c))

SEND(Send) SEND(Ssend) SEND(Rsend) SEND(Bsend) ISEND(Isend) ISEND(Issend) ISEND(Irsend) ISEND(Ibsend)
WRAP(Sendrecv, (const void *b, int n, MPI_Datatype t, int to, int tag, void *rb, int rn, MPI_Datatype rt, int from, int rtag,
     MPI_Comm c, MPI_Status *s), (b, n, t, to, tag, rb, rn, rt, from, rtag, c, s), message(n, t, to, c))

WRAP(Recv, (void *b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Status *s), (b, n, t, from, tag, c, s), begin())
WRAP(Irecv, (void *b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Request *r), (b, n, t, from, tag, c, r), begin())
WRAP(Probe, (int from, int tag, MPI_Comm c, MPI_Status *s), (from, tag, c, s), begin())
WRAP(Iprobe, (int from, int tag, MPI_Comm c, int *f, MPI_Status *s), (from, tag, c, f, s), begin())
WRAP(Wait, (MPI_Request *r, MPI_Status *s), (r, s), begin())
WRAP(Waitall, (int n, MPI_Request r[], MPI_Status s[]), (n, r, s), begin())
WRAP(Waitany, (int n, MPI_Request r[], int *i, MPI_Status *s), (n, r, i, s), begin())
WRAP(Waitsome, (int n, MPI_Request r[], int *m, int i[], MPI_Status s[]), (n, r, m, i, s), begin())
WRAP(Test, (MPI_Request *r, int *f, MPI_Status *s), (r, f, s), begin())
WRAP(Testall, (int n, MPI_Request r[], int *f, MPI_Status s[]), (n, r, f, s), begin())
WRAP(Testany, (int n, MPI_Request r[], int *i, int *f, MPI_Status *s), (n, r, i, f, s), begin())
WRAP(Testsome, (int n, MPI_Request r[], int *m, int i[], MPI_Status s[]), (n, r, m, i, s), begin())

#define REDUCED const void *b, void *rb, int n, MPI_Datatype t, MPI_Op op
#define GATHERED const void *b, int n, MPI_Datatype t, void *rb
WRAP(Barrier, (MPI_Comm c), (c), collective(0))
WRAP(Ibarrier, (MPI_Comm c, MPI_Request *r), (c, r), collective(0))
WRAP(Bcast, (void *b, int n, MPI_Datatype t, int root, MPI_Comm c), (b, n, t, root, c), collective(size_of(n, t)))
WRAP(Ibcast, (void *b, int n, MPI_Datatype t, int root, MPI_Comm c, MPI_Request *r), (b, n, t, root, c, r), collective(size_of(n, t)))
WRAP(Reduce, (REDUCED, int root, MPI_Comm c), (b, rb, n, t, op, root, c), collective(size_of(n, t)))
WRAP(Allreduce, (REDUCED, MPI_Comm c), (b, rb, n, t, op, c), collective(2 * size_of(n, t)))
WRAP(Iallreduce, (REDUCED, MPI_Comm c, MPI_Request *r), (b, rb, n, t, op, c, r), collective(2 * size_of(n, t)))
WRAP(Scan, (REDUCED, MPI_Comm c), (b, rb, n, t, op, c), collective(2 * size_of(n, t)))
WRAP(Exscan, (REDUCED, MPI_Comm c), (b, rb, n, t, op, c), collective(2 * size_of(n, t)))
WRAP(Gather, (GATHERED, int m, MPI_Datatype rt, int root, MPI_Comm c), (b, n, t, rb, m, rt, root, c),
     collective(is_root(root, c) ? size_of((double)m * size(c), rt) : size_of(n, t)))
WRAP(Gatherv, (GATHERED, const int *m, const int *d, MPI_Datatype rt, int root, MPI_Comm c), (b, n, t, rb, m, d, rt, root, c),
     collective(is_root(root, c) ? size_of(total(m, c), rt) : size_of(n, t)))
WRAP(Scatter, (GATHERED, int m, MPI_Datatype rt, int root, MPI_Comm c), (b, n, t, rb, m, rt, root, c),
     collective(is_root(root, c) ? size_of((double)n * size(c), t) : size_of(m, rt)))
WRAP(Scatterv, (const void *b, const int *n, const int *d, MPI_Datatype t, void *rb, int m, MPI_Datatype rt, int root, MPI_Comm c),
     (b, n, d, t, rb, m, rt, root, c), collective(is_root(root, c) ? size_of(total(n, c), t) : size_of(m, rt)))
WRAP(Allgather, (GATHERED, int m, MPI_Datatype rt, MPI_Comm c), (b, n, t, rb, m, rt, c), collective(size_of((double)m * size(c), rt)))
WRAP(Allgatherv, (GATHERED, const int *m, const int *d, MPI_Datatype rt, MPI_Comm c), (b, n, t, rb, m, d, rt, c),
     collective(size_of(total(m, c), rt)))
WRAP(Alltoall, (GATHERED, int m, MPI_Datatype rt, MPI_Comm c), (b, n, t, rb, m, rt, c), collective(2 * size_of((double)m * size(c), rt)))
WRAP(Alltoallv, (const void *b, const int *n, const int *d, MPI_Datatype t, void *rb, const int *m, const int *e, MPI_Datatype rt, MPI_Comm c),
     (b, n, d, t, rb, m, e, rt, c), collective(size_of(total(n, c), t) + size_of(total(m, c), rt)))
WRAP(Reduce_scatter, (const void *b, void *rb, const int *n, MPI_Datatype t, MPI_Op op, MPI_Comm c), (b, rb, n, t, op, c),
     collective(size_of(total(n, c), t)))
WRAP(Reduce_scatter_block, (REDUCED, MPI_Comm c), (b, rb, n, t, op, c), collective(size_of((double)n * size(c), t)))
WRAP(Comm_dup, (MPI_Comm c, MPI_Comm *d), (c, d), collective(4))
WRAP(Comm_split, (MPI_Comm c, int color, int key, MPI_Comm *d), (c, color, key, d), collective(8. * size(c)))
WRAP(Comm_create, (MPI_Comm c, MPI_Group g, MPI_Comm *d), (c, g, d), collective(4))
WRAP(Comm_free, (MPI_Comm *c), (c), collective(0))

/* Calls from Fortran, those that MUMPS makes; MPI's library then bypasses the functions above. */
typedef MPI_Fint Int;
#define FORTRAN(name, declaration, arguments, count) \
  void pmpi_##name##_ declaration;                   \
  void mpi_##name##_ declaration                     \
  {                                                  \
    count;                                           \
    pmpi_##name##_ arguments;                        \
    end(0);                                          \
  }
#define TYPE MPI_Type_f2c(*t)
#define COMM MPI_Comm_f2c(*c)
#define FSEND(name) \
  FORTRAN(name, (void *b, Int *n, Int *t, Int *to, Int *tag, Int *c, Int *e), (b, n, t, to, tag, c, e), message(*n, TYPE, *to, COMM))
FSEND(send) FSEND(ssend)
FORTRAN(isend, (void *b, Int *n, Int *t, Int *to, Int *tag, Int *c, Int *r, Int *e), (b, n, t, to, tag, c, r, e), message(*n, TYPE, *to, COMM))
FORTRAN(recv, (void *b, Int *n, Int *t, Int *from, Int *tag, Int *c, Int *s, Int *e), (b, n, t, from, tag, c, s, e), begin())
FORTRAN(irecv, (void *b, Int *n, Int *t, Int *from, Int *tag, Int *c, Int *r, Int *e), (b, n, t, from, tag, c, r, e), begin())
FORTRAN(probe, (Int *from, Int *tag, Int *c, Int *s, Int *e), (from, tag, c, s, e), begin())
FORTRAN(iprobe, (Int *from, Int *tag, Int *c, Int *f, Int *s, Int *e), (from, tag, c, f, s, e), begin())
FORTRAN(wait, (Int *r, Int *s, Int *e), (r, s, e), begin())
FORTRAN(waitall, (Int *n, Int *r, Int *s, Int *e), (n, r, s, e), begin())
FORTRAN(waitany, (Int *n, Int *r, Int *i, Int *s, Int *e), (n, r, i, s, e), begin())
FORTRAN(test, (Int *r, Int *f, Int *s, Int *e), (r, f, s, e), begin())
FORTRAN(barrier, (Int *c, Int *e), (c, e), collective(0))
FORTRAN(bcast, (void *b, Int *n, Int *t, Int *root, Int *c, Int *e), (b, n, t, root, c, e), collective(size_of(*n, TYPE)))
FORTRAN(reduce, (void *b, void *rb, Int *n, Int *t, Int *op, Int *root, Int *c, Int *e), (b, rb, n, t, op, root, c, e),
        collective(size_of(*n, TYPE)))
FORTRAN(allreduce, (void *b, void *rb, Int *n, Int *t, Int *op, Int *c, Int *e), (b, rb, n, t, op, c, e),
        collective(2 * size_of(*n, TYPE)))
FORTRAN(gather, (void *b, Int *n, Int *t, void *rb, Int *m, Int *rt, Int *root, Int *c, Int *e), (b, n, t, rb, m, rt, root, c, e),
        collective(size_of(*n, TYPE) * (is_root(*root, COMM) ? size(COMM) : 1)))
FORTRAN(alltoall, (void *b, Int *n, Int *t, void *rb, Int *m, Int *rt, Int *c, Int *e), (b, n, t, rb, m, rt, c, e),
        collective(2 * size_of(*n, TYPE) * size(COMM)))
FORTRAN(reduce_scatter, (void *b, void *rb, Int *n, Int *t, Int *op, Int *c, Int *e), (b, rb, n, t, op, c, e),
        collective(size_of(total(n, COMM), TYPE)))
FORTRAN(comm_dup, (Int *c, Int *d, Int *e), (c, d, e), collective(4))
FORTRAN(comm_split, (Int *c, Int *color, Int *key, Int *d, Int *e), (c, color, key, d, e), collective(8. * size(COMM)))
FORTRAN(comm_free, (Int *c, Int *e), (c, e), collective(0))

  /* clang-format on */
  /* Not counted: so it had better not happen. */
  static int refuse(const char *name)
{
  fprintf(stderr, "mpi_counts: %s is not counted\n", name);
  return PMPI_Abort(MPI_COMM_WORLD, 1);
}
int
MPI_Start(MPI_Request *r)
{
  return refuse("MPI_Start"), (void)r, 1;
}
int
MPI_Startall(int n, MPI_Request r[])
{
  return refuse("MPI_Startall"), (void)n, (void)r, 1;
}

/* Sums of what all ranks sent to this one. */
static void
received(const double *to, double *sum, int *partners)
{
  double *from = calloc(world_size, sizeof(double));
  PMPI_Alltoall(to, 1, MPI_DOUBLE, from, 1, MPI_DOUBLE, MPI_COMM_WORLD);
  *sum      = 0;
  *partners = 0;
  for (int r = 0; r < world_size; ++r)
    {
      *sum += from[r];
      *partners += from[r] > 0;
    }
  free(from);
}

int
MPI_Finalize(void)
{
  char        path[4096];
  int         rank;
  const char *directory = getenv("MPI_COUNTS");
  begin();
  leave_stage();
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  snprintf(path, sizeof path, "%s/%d.csv", directory ? directory : ".", rank);
  FILE *file = fopen(path, "w");
  if (file)
    fprintf(
      file,
      "rank,stage,sent,bytes_sent,received,bytes_received,partners,collectives,collective_bytes,cpu,wall,wall_mpi,peak_kib\n");
  for (int i = 0; i < n_stages; ++i)
    {
      const struct Stage *s = &stages[i];
      double              messages, bytes;
      int                 partners, unused;
      received(s->bytes_to, &bytes, &unused);
      received(s->messages_to, &messages, &partners);
      if (file)
        fprintf(file,
                "%d,%s,%.0f,%.0f,%.0f,%.0f,%d,%.0f,%.0f,%.6f,%.6f,%.6f,%ld\n",
                rank,
                s->name,
                s->sent,
                s->bytes_sent,
                messages,
                bytes,
                partners,
                s->collectives,
                s->collective_bytes,
                s->cpu,
                s->wall,
                s->wall_mpi,
                s->peak_kib);
    }
  if (file)
    fclose(file);
  return PMPI_Finalize();
}
