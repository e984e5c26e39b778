/** Types that several modules of the page use, by their names alone. */

type Analyses = import('./analyses.js').Analyses;
type Api = import('./api.js').Api;
type Card = import('./gallery/cards.js').Card;
type Colour = import('./surface/colours.js').Colour;
type DewarpedPage = import('../pkg/types.js').DewarpedPage;
type Drawing = import('../pkg/types.js').Drawing;
type Energy = import('../pkg/types.js').Energy;
type ExampleName = import('../pkg/types.js').ExampleName;
type FlatPage = import('../pkg/types.js').FlatPage;
type Input = import('./session.js').Input;
type Mesh = import('../pkg/types.js').Mesh;
type MeshFit = import('./mesh-fit.js').MeshFit;
type MeshSurface = import('../pkg/types.js').MeshSurface;
type NoData = import('./import-interpretation.js').NoData;
type PagePhoto = import('./page/photo.js').PagePhoto;
type PackageWorker = import('./worker-task.js').Worker;
type PageSession = import('./page/session.js').PageSession;
type PageState = import('./page/session.js').PageState;
type PatternOptions = import('../pkg/types.js').PatternOptions;
type Picture = import('./surface/picture-view.js').Picture;
type Progress = import('../pkg/types.js').Progress;
type Result = import('./session.js').Result;
type SampleMeshOptions = import('../pkg/types.js').SampleMeshOptions;
type Session = import('./session.js').Session;
type Settings = import('./session.js').Settings;
type Stage = import('./panels/stage.js').Stage;
type Subject = import('./panels/stage.js').Subject;
type Task = import('./messages.js').Task;
type Tell = import('./mesh-fit.js').Tell;
type ViewContent = import('./surface/layer.js').ViewContent;

/** Text recognition of the Shape Detection API, which few browsers have. */
declare var TextDetector: undefined | (new () => { detect(image: ImageData): Promise<{ rawValue: string, boundingBox: DOMRectReadOnly }[]> });
