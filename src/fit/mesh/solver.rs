//! The fit of a mesh as a sequence of linearisations.

use web_time::Instant;

use super::base::first_base;
use super::bounding_sphere::BoundingSphere;
use super::finishing::{fair_creases, untangle};
use super::geometry::{Frame, Point, normals};
use super::input::MeshInput;
use super::known::MeshKnown;
use super::level_vertices::LevelVertices;
use super::levels::MeshLevels;
use super::linearisation::Linearisation;
use super::noise_level::{MeshNoise, mean_spacing};
use super::options::MeshOptions;
use super::orientation::unfold;
use super::reach::reach;
use super::report::{EntangledTriangle, MeshPass, MeshReport};
use super::self_intersections::separate_self_intersections;
use super::shape_measures::ShapeMeasures;
use super::smooth_regions::SmoothRegions;
use super::topology::Topology;
use crate::error::{Result, try_filled};
use crate::fit::admm::parameters::AdmmParameters;
use crate::fit::component_solver::Status;
use crate::fit::energy::spectral_penalty::HuberParameters;
use crate::fit::options::Lambda;
use crate::fit::report::{Progress, Seconds, StopReason};
use crate::scene::mesh::Mesh;

/// Product of λ, the noise's standard deviation and the spacing of vertices, in normalised coordinates, that determines
/// λ where none is given (`benches/whole.md`).
const LAMBDA_NOISE_PRODUCT: f64 = 6.4;

/// Relative duality gap at which all solves but the last one stop, which give the next one a base and the creases
/// (`benches/whole.md`).
const EARLY_SOLVE_GAP: f64 = 0.02;

/// Minimum standard deviation of noise that λ is chosen by, in spacings of vertices; smaller noise counts as none.
const MIN_NOISE_SPACINGS: f64 = 1e-4;

/// Minimum standard deviation, in spacings of vertices, of noise that is removed: less turns edges by under a degree, and exact surfaces of
/// CAD are as far from the quadratics that noise is measured by (`benches/whole.md`, Meshes without noise).
const MIN_REMOVED_NOISE_SPACINGS: f64 = 0.01;

/// Maximum ratio of λ to the value that suits the noise at which there are crease passes; with a larger λ, noise would
/// be taken for creases.
const MAX_CREASE_LAMBDA_RATIO: f64 = 4.0;

/// Result of a mesh's fit: the fitted mesh, and the report.
#[derive(Debug, Clone)]
pub struct MeshSurface {
    mesh: Mesh,
    report: MeshReport,
}

impl MeshSurface {
    /// Fitted mesh: vertices, triangles, colours, texture coordinates and textures of the input in the same order, with
    /// moved vertices.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Report of the fit.
    pub fn report(&self) -> &MeshReport {
        &self.report
    }

    /// Returns the fitted mesh and the report of the fit.
    pub fn into_parts(self) -> (Mesh, MeshReport) {
        (self.mesh, self.report)
    }
}

/// Fit of a mesh that runs in steps, so that its caller can look at its progress or stop it in between.
#[derive(Debug, Clone)]
pub struct MeshSolver {
    mesh: Mesh,
    options: MeshOptions,
    given: MeshInput,
    bounds: BoundingSphere,
    lambda: f64,
    sigma: Option<f64>,
    /// Triangles of the surface that are folded over or cross others, when the fit is finished.
    entangled: Vec<u32>,
    /// Solve of the current or the last linearised problem; `None` of a mesh that is left as it is.
    levels: Option<MeshLevels>,
    /// Positions of the vertices so far, in normalised coordinates.
    surface: Vec<Point>,
    /// Positions of the vertices before crease passes.
    smooth: Option<Vec<Point>>,
    passes: Vec<MeshPass>,
    before: ShapeMeasures,
    reason: Option<StopReason>,
    seconds: Seconds,
    start: Instant,
}

/// Moves the vertices of a mesh so that it is piecewise developable, whatever its shape: closed,
/// overhanging, with borders or in parts.
///
/// The surface minimises `λ Σ w s² + Σ w φ(‖II‖_*)`, where `s` is the distance of a vertex from its input position
/// along the normal, `w` its share of the area, `II` the second fundamental form, and `φ` the Huber penalty of
/// [`Energy::Huber`](crate::Energy::Huber). The energy is linearised about a smoothed base and solved as on a
/// lattice, and once more about the result, where vertices on creases also move across their rays. Unless
/// `crease_passes` is 0, borders and creases then become smooth curves. Last, self-intersections and folded triangles
/// are removed by moving their vertices towards the mean of their neighbours. With [`Lambda::Auto`] a mesh that has no noise
/// ([`Mesh::is_exact`]), or less than a hundredth of the spacing of its vertices, is left as it is.
///
/// # Errors
/// [`Error::Topology`](crate::Error::Topology) if the mesh is no surface and cannot safely be made one, and
/// says where; [`Error::Unsupported`](crate::Error::Unsupported) for a cloud of points,
/// [`Error::Option`](crate::Error::Option), or out of memory.
pub fn fit_mesh(mesh: &Mesh, options: &MeshOptions) -> Result<MeshSurface> {
    let mut solver = MeshSolver::new(mesh.clone(), MeshKnown::default(), options)?;
    while solver.advance(1000)? == Status::Running {}
    solver.surface()
}

impl MeshSolver {
    /// Sets up the fit of a mesh.
    ///
    /// # Errors
    /// As [`fit_mesh`]; [`Error::Shape`](crate::Error::Shape) if `known` is not of as many vertices.
    pub fn new(mesh: Mesh, known: MeshKnown, options: &MeshOptions) -> Result<Self> {
        let start = Instant::now();
        options.validate()?;
        let topology = Topology::in_spatial_order(&mesh)?;
        let bounds = BoundingSphere::from_mesh(&mesh)?;
        let noisy: Vec<Point> = topology
            .source
            .iter()
            .map(|vertex| bounds.inward(mesh.positions()[*vertex as usize]))
            .collect();
        let (confidence, held) = known.for_topology(&mesh, &topology)?;
        let mut given = MeshInput {
            reach: try_filled("vertices", topology.len(), f64::INFINITY)?,
            topology,
            noisy,
            confidence,
            held,
        };
        let is_auto = matches!(options.lambda, Lambda::Auto);
        let is_exact = is_auto && mesh.is_exact();
        // Without noise there is no reach, and without reach slivers spoil the base.
        let MeshNoise {
            sigma,
            spacing,
            base_repeats,
        } = MeshNoise::of(&given, is_exact);
        let is_small = sigma.is_some_and(|sigma| sigma < MIN_REMOVED_NOISE_SPACINGS * spacing);
        // The noise of most vertices says nothing of those that are trusted less.
        let is_left = is_exact || (is_auto && is_small && given.confidence.is_empty());
        let auto = sigma.map_or(Lambda::Medium.value(), |sigma| {
            LAMBDA_NOISE_PRODUCT / (sigma.max(MIN_NOISE_SPACINGS * spacing) * spacing)
        });
        let lambda = match options.lambda {
            Lambda::Auto => auto,
            given => given.value(),
        };
        given.reach = reach(&given, sigma, spacing);
        // A smaller λ asks for more than the removal of noise.
        let relief = (auto / lambda).max(1.0);
        given.reach.iter_mut().for_each(|reach| *reach *= relief);
        let (base, frames) = first_base(&given, base_repeats);
        let topology = &given.topology;
        let mut options = *options;
        if lambda > MAX_CREASE_LAMBDA_RATIO * auto {
            options.crease_passes.get_or_insert(0);
        }
        let smooth = if is_left { &given.noisy } else { &base };
        let before = ShapeMeasures::new(topology, &given.noisy, smooth);
        let (levels, reason) = if is_left {
            (None, None)
        } else {
            let linear = linearise(&given, base, frames, &options, lambda, None)?;
            let first = parameters(&options, 0);
            let (levels, reason) = MeshLevels::new(linear, None, &options, first)?;
            (Some(levels), reason)
        };
        let mut solver = MeshSolver {
            mesh,
            options,
            bounds,
            lambda,
            sigma,
            entangled: Vec::new(),
            levels,
            surface: given.noisy.clone(),
            smooth: None,
            given,
            passes: Vec::new(),
            before,
            reason: is_left.then_some(StopReason::NoNoise),
            seconds: Seconds::default(),
            start,
        };
        if let Some(reason) = reason {
            solver.finish(reason)?;
        }
        solver.seconds.setup = start.elapsed().as_secs_f64();
        Ok(solver)
    }

    /// Continues the fit for about this number of conjugate-gradient iterations.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn advance(&mut self, iterations: usize) -> Result<Status> {
        let mut left = iterations;
        while self.reason.is_none()
            && left > 0
            && let Some(levels) = &mut self.levels
        {
            if let Some(reason) = levels.advance(&mut left)? {
                self.finish(reason)?;
                // A further linearisation takes as much work as one call.
                left = 0;
            }
        }
        Ok(match self.reason {
            Some(reason) => Status::Stopped(reason),
            None => Status::Running,
        })
    }

    /// Stops a running fit as cancelled: the best surface of the pass under way is prolonged to all vertices, and finished as at
    /// the end of the fit.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn cancel(&mut self) -> Result<()> {
        if self.reason.is_none()
            && let Some(levels) = &mut self.levels
        {
            levels.prolong_to_finest()?;
            self.finish(StopReason::Cancelled)?;
        }
        Ok(())
    }

    /// Returns the progress of the fit, which solves several linearised problems in turn: `objective`, `dual_bound`, `gap` and
    /// `rho` are those of the current one at its last check, iterations count over all of them, and `level` is the number of
    /// problems still to come at most.
    pub fn progress(&self) -> Progress {
        let Some(levels) = &self.levels else {
            return Progress::default();
        };
        let admm = &levels.solver.admm;
        let done = |of: fn(&MeshPass) -> usize| self.passes.iter().map(of).sum::<usize>();
        let under_way = match self.reason {
            None | Some(StopReason::Cancelled) => levels.iterations(),
            Some(_) => [0; 2],
        };
        Progress {
            level: self
                .options
                .crease_passes_or_default()
                .saturating_sub(self.passes.len()),
            iteration: done(|pass| pass.iterations) + under_way[0],
            cg_iterations: done(|pass| pass.cg_iterations) + under_way[1],
            objective: admm.incumbent.objective(),
            dual_bound: admm.incumbent.dual_bound,
            gap: Some(admm.incumbent.gap()),
            rho: admm.iterate.rho,
            elapsed: self.start.elapsed().as_secs_f64(),
        }
    }

    /// Takes over the result of a linearised problem, and goes on to the next one or ends the fit.
    fn finish(&mut self, reason: StopReason) -> Result<()> {
        let Some(levels) = self.levels.take() else {
            return Ok(());
        };
        let admm = &levels.solver.admm;
        let linear = levels.finest();
        let [iterations, cg_iterations] = levels.iterations();
        let last = self.passes.len() >= self.options.crease_passes_or_default();
        let mut next = linear.moved(&admm.incumbent.z);
        self.given.keep_within_reach(&mut next);
        let topology = &self.given.topology;
        let old: Vec<Point> = linear.vertices.frames.iter().map(|f| f.normal).collect();
        let up = normals(topology, &next, Some(&old));
        unfold(&self.given, &mut next, &up);
        let moved = next
            .iter()
            .zip(&linear.vertices.base)
            .map(|(a, b)| (a - b).norm());
        let squares = moved.clone().map(|d| d * d).sum::<f64>();
        let scale = self.bounds.scale;
        self.passes.push(MeshPass {
            iterations,
            cg_iterations,
            objective: admm.incumbent.objective(),
            dual_bound: admm.incumbent.dual_bound,
            gap: Some(admm.incumbent.gap()),
            stop_reason: reason,
            creases: levels.creases,
            moved: (squares / next.len() as f64).sqrt() / scale,
            moved_most: moved.fold(0.0, f64::max) / scale,
        });
        self.seconds = self.seconds + levels.seconds();
        self.surface = next;
        let done = last || !matches!(reason, StopReason::Gap | StopReason::Residuals);
        let (given, surface) = (&self.given, &mut self.surface);
        if done && self.options.crease_passes_or_default() > 0 {
            let sides = SmoothRegions::new(&given.topology, surface)?;
            let (before, frames) = (self.smooth.as_deref(), &linear.vertices.frames);
            fair_creases(given, &sides, surface, before, frames, self.sigma);
            // Normals beside creases have changed.
            let up = normals(&given.topology, surface, Some(&old));
            unfold(given, surface, &up);
            self.entangled = untangle(given, surface, &|v| sides.is_on_crease(v));
        } else if done {
            self.entangled = untangle(given, surface, &|_| false);
        } else {
            separate_self_intersections(given, surface, &|_| false);
        }
        if done {
            self.reason = Some(reason);
            self.levels = Some(levels);
            return Ok(());
        }
        self.smooth.get_or_insert_with(|| surface.clone());
        let start = Instant::now();
        let frames = normals(&self.given.topology, &self.surface, Some(&old))
            .into_iter()
            .zip(&linear.vertices.frames)
            .map(|(normal, hint)| Frame::from_normal(normal, hint.tangents[0]))
            .collect();
        let base = self.surface.clone();
        let sides = SmoothRegions::new(&self.given.topology, &base)?;
        let (options, lambda) = (&self.options, self.lambda);
        let next = linearise(&self.given, base, frames, options, lambda, Some(&sides))?;
        let warm = levels.warm_start(&next, sides)?;
        let (levels, reason) = MeshLevels::new(
            next,
            Some(&warm),
            options,
            parameters(options, self.passes.len()),
        )?;
        self.levels = Some(levels);
        if let Some(reason) = reason {
            self.finish(reason)?;
        }
        self.seconds.setup += start.elapsed().as_secs_f64();
        Ok(())
    }

    /// Returns the surface after the last finished pass, or as it was when the fit was [cancelled](MeshSolver::cancel). Before the first
    /// pass has ended it is the input.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn surface(&self) -> Result<MeshSurface> {
        let topology = &self.given.topology;
        let mut positions = self.mesh.positions().to_vec();
        // Vertices without a triangle stay exactly where they are.
        let moved = self.levels.iter().flat_map(|_| self.mesh.triangles());
        for corner in moved.flatten() {
            let joined = topology.joined[*corner as usize];
            if !self.given.held[joined as usize] {
                positions[*corner as usize] = self.bounds.outward(self.surface[joined as usize]);
            }
        }
        let after = ShapeMeasures::new(topology, &self.surface, &self.surface);
        let (length, closed) = (1.0 / self.bounds.scale, topology.closed);
        let inside = topology.vertices_inside().count();
        let finest = self.levels.as_ref().map(MeshLevels::finest);
        let (interior, spacing) = match finest {
            Some(finest) => (finest.centres.len(), finest.spacing),
            None => (inside, mean_spacing(topology, &self.surface)),
        };
        let mut seconds = self.seconds;
        seconds.total = self.start.elapsed().as_secs_f64();
        Ok(MeshSurface {
            mesh: self.mesh.clone().moved_to(positions)?,
            report: MeshReport {
                vertices: topology.len(),
                interior,
                border: topology.len() - inside,
                pinched: topology.pinched,
                components: topology.components,
                repairs: topology.repairs,
                spacing: spacing * length,
                scale: self.bounds.scale,
                sigma: self.sigma.map(|sigma| sigma * length),
                lambda: self.lambda,
                passes: self.passes.clone(),
                volume: closed
                    .then(|| [self.before.volume, after.volume].map(|v| v * length.powi(3))),
                area: [self.before.area, after.area].map(|a| a * length.powi(2)),
                flipped: [self.before.flipped, after.flipped],
                entangled: self
                    .entangled
                    .iter()
                    .map(|t| self.entangled_triangle(*t))
                    .collect(),
                stop_reason: self.reason.unwrap_or(StopReason::Cancelled),
                seconds,
            },
        })
    }

    /// Locates a triangle of the topology in the mesh, and its middle on the surface so far.
    fn entangled_triangle(&self, triangle: u32) -> EntangledTriangle {
        let corners = self.given.topology.triangles[triangle as usize];
        let sum: Point = corners.iter().map(|i| self.surface[*i as usize]).sum();
        EntangledTriangle {
            triangle: self.given.topology.from[triangle as usize] as usize,
            position: self.bounds.outward(sum / 3.0),
        }
    }
}

/// Parameters of ADMM for the solve after a number of other ones.
fn parameters(options: &MeshOptions, solved: usize) -> AdmmParameters {
    let mut common = options.common();
    if solved < options.crease_passes_or_default() {
        common = common.gap(options.gap.max(EARLY_SOLVE_GAP));
    }
    AdmmParameters::new(&common).for_mesh()
}

/// Linearises the energy about a base, with the options of the fit.
fn linearise(
    given: &MeshInput,
    base: Vec<Point>,
    frames: Vec<Frame>,
    options: &MeshOptions,
    lambda: f64,
    sides: Option<&SmoothRegions>,
) -> Result<Linearisation> {
    let bends = HuberParameters::from_options(&options.common());
    let vertices = LevelVertices::from_mesh(given, base, frames, sides);
    Linearisation::new(vertices, bends, lambda, sides)
}
