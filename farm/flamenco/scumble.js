// A job type for Flamenco 3: scumble draws a sequence of frames in portions, looks whether all are there, and
// makes a film of them. Put this file into the folder `scripts` beside flamenco-manager; docs/farm.md tells more.
//
// Tasks call scumble itself, without a shell. A frame's file appears whole or not at all, and frames that are
// there are left out: so a task may be tried again, on any worker, also while a process that an earlier try has
// left behind still draws.

const JOB_TYPE = {
    label: "scumble",
    settings: [
        { key: "scene", type: "string", subtype: "file_path", required: true,
          description: "glTF 2.0 file (.gltf or .glb), painting or world; workers see it under this path" },
        { key: "look", type: "string", default: "",
          description: "A look that ships, or a JSON file; empty: the one beside the scene, else age-of-sail" },
        { key: "frames", type: "string", required: true, default: "0-239",
          description: "Frames to draw. Examples: '47', '1-30', '3, 5-10, 47-327'" },
        { key: "chunk_size", type: "int32", default: 25, propargs: { min: 1 }, visible: "submission",
          description: "Frames a task. Starting takes about a second, so a task should take a minute or more" },
        { key: "fps", type: "float", default: 24, description: "Frame n is at n / fps seconds" },
        { key: "output", type: "string", subtype: "file_path", required: true,
          description: "Frames, like /shared/shot.####.exr; .png, .jpg, .webp, .exr or .svg" },
        { key: "options", type: "string", default: "",
          description: "More options of `scumble render`, one a line or separated by spaces; quotes keep words together" },
        { key: "film", type: "string", subtype: "file_path", default: "",
          description: "A film of the frames, made at the end: .mp4, .webm or .gif; empty: none" },
        { key: "scumble_cmd", type: "string", default: "scumble", visible: "web",
          description: "The program on the workers, e.g. a variable like {scumble}" },
    ],
};

function compileJob(job) {
    const settings = job.settings;
    const ranges = rangesOf(frameChunker(settings.frames, 1000000000)[0]);
    if (settings.film && ranges.length > 1)
        throw new Error("a film is made of frames without gaps, and these have some: " + settings.frames);

    const check = task("check", "misc", settings, ranges.map(function (range) {
        return renderWords(settings, range, "--missing");
    }));
    for (const chunk of frameChunker(settings.frames, settings.chunk_size)) {
        const render = task("render " + chunk, "scumble", settings, rangesOf(chunk).map(function (range) {
            return renderWords(settings, range, "--resume");
        }));
        check.addDependency(render);
        job.addTask(render);
    }
    job.addTask(check);
    if (settings.film) {
        const film = task("film", "ffmpeg", settings, filmCalls(settings, ranges[0]));
        film.addDependency(check);
        job.addTask(film);
    }
}

// A task of calls, one after the other.
function task(name, type, settings, calls) {
    const made = author.Task(name, type);
    for (const words of calls)
        made.addCommand(author.Command("exec", { exe: settings.scumble_cmd, args: words }));
    return made;
}

function renderWords(settings, range, how) {
    const words = ["render"].concat(wordsOf(settings.options || ""));
    if (settings.look) words.push("--look=" + settings.look);
    return words.concat(["--frames=" + range, "--fps=" + settings.fps, "--output=" + settings.output, how, settings.scene]);
}

// What players have to know of the frames is among their options; each of separate eyes has a film.
function filmCalls(settings, range) {
    const options = wordsOf(settings.options || "");
    const words = ["film", "--frames=" + range, "--fps=" + settings.fps];
    for (const name of ["--stereo", "--panorama"])
        if (valueOf(options, name)) words.push(name + "=" + valueOf(options, name));
    const eyes = valueOf(options, "--stereo") === "separate" ? [".left", ".right"] : [""];
    return eyes.map(function (eye) {
        return words.concat(["--output=" + withPart(settings.film, eye), withPart(settings.output, eye)]);
    });
}

// Of "--name value" or "--name=value".
function valueOf(words, name) {
    for (let i = 0; i < words.length; ++i) {
        if (words[i] === name) return words[i + 1];
        if (words[i].startsWith(name + "=")) return words[i].substring(name.length + 1);
    }
    return "";
}

// "dir/name.png" with ".left" is "dir/name.left.png".
function withPart(file, part) {
    const dot = file.lastIndexOf(".");
    return file.substring(0, dot) + part + file.substring(dot);
}

// Flamenco's "3-10,12,13" as scumble's "3..10" and "12..13".
function rangesOf(chunk) {
    const ranges = [];
    for (const part of chunk.split(",")) {
        const ends = part.trim().split("-").map(Number);
        const first = ends[0], last = ends[ends.length - 1];
        const before = ranges[ranges.length - 1];
        if (before && before[1] + 1 === first) before[1] = last;
        else ranges.push([first, last]);
    }
    return ranges.map(function (range) { return range[0] + ".." + range[1]; });
}

// As a shell would split them: white space between words, but not within quotes.
function wordsOf(text) {
    const words = [];
    const pattern = /(?:[^\s"']|"[^"]*"|'[^']*')+/g;
    let found;
    while ((found = pattern.exec(text)) !== null)
        words.push(found[0].replace(/"([^"]*)"|'([^']*)'/g, function (all, double, single) {
            return double === undefined ? single : double;
        }));
    return words;
}
